"""unittest.main that prints and notes the processor time of each test, with that of the programs it ran; see measured.py."""
import os
import resource
import sys
import unittest


def used():
    return sum(u.ru_utime + u.ru_stime for u in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def note(case, seconds):
    """Notes the processor time of a case for measured.py."""
    if path := os.environ.get("HOLOMORPH_SECONDS"):
        with open(path, "a") as file:
            file.write(f"{seconds:.2f}\t{case}\n")


class TimedResult(unittest.TextTestResult):
    def startTest(self, test):
        self.start = used()
        super().startTest(test)

    def stopTest(self, test):
        super().stopTest(test)
        seconds = used() - self.start
        self.stream.writeln(f"    {seconds:.2f} s {test.id()}")
        note(test.id().removeprefix("__main__."), seconds)


def main(words):
    """Runs the tests that `words` name, or all."""
    runner = unittest.TextTestRunner(verbosity=2, warnings="ignore", resultclass=TimedResult)
    unittest.main(argv=[sys.argv[0], *words], testRunner=runner)
