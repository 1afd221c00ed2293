#!/usr/bin/env python3
"""Each promise of the documents names the tests that try to break it.

A sentence is a promise if it has a figure, or one of the words never, always, each, every and cannot. promises.tsv has
the document, a phrase of the sentence, and its tests: scripts, or "FILE: CASE". descriptions.tsv has phrases of the
sentences that have such words but promise nothing, because they tell how to use something.
"""
import csv
import os
import re
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
DOCUMENTS = ("README.md", "SECURITY.md", "docs/guide.md", "docs/manual.md")
NUMBER = r"(\d+([.,]\d+)*|half an?|two|three|four|five|six|seven|eight|nine|ten)"
UNIT = (r"(px|%|[kMG]B|(mega)?pixels?|million|ms|s|seconds?|minutes?|hours?|days?|bits?|layers?|frames?|times|degrees?|"
        r"radians?|levels?|steps|samples|examples|keyframes|vertices)")
PROMISE = re.compile(r"\b(never|always|each|every|cannot)\b|(hundred|thousand|illion)ths?\b|"
                     rf"(?<![\w.,]){NUMBER} {UNIT}(?!\w)", re.I)


def read(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


def rows(name):
    with open(os.path.join(HERE, name), newline="") as file:
        return list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))


def sentences(text):
    """The sentences, table rows and list items of a document, without headings, code and pictures."""
    text = re.sub(r"^(#| {4}).*$|!\[[^]]*\]\([^)]*\)", "", text, flags=re.M)
    text = re.sub(r"^(?=\||\s*- |\s*\d+\. )", "\n", text, flags=re.M)
    for block in re.split(r"\n\s*\n", text):
        yield from re.split(r"(?<=[.?!])\s|(?<=[.?!]\*\*)\s", " ".join(block.split()))


def has_test(test):
    """Whether a test exists: a file, or a case of it."""
    path, _, case = test.partition(": ")
    if not os.path.isfile(os.path.join(ROOT, path)):
        return False
    text = re.sub(r'"\s*\n\s*"', "", read(path))  # joins the parts of long names
    if path.endswith(".cpp"):
        return not case or re.search(r"TEST_CASE\(\s*" + re.escape(f'"{case}"'), text)
    return all(re.search(rf"^ *(class|def) {name}\(", text, re.M) for name in case.split(".") if name)


class Promises(unittest.TestCase):
    def test_each_phrase_is_in_its_document_once(self):
        for row in rows("promises.tsv") + rows("descriptions.tsv"):
            with self.subTest(row["PHRASE"]):
                self.assertIn(row["DOCUMENT"], DOCUMENTS)
                self.assertEqual(" ".join(read(row["DOCUMENT"]).split()).count(row["PHRASE"]), 1)

    def test_each_promise_names_tests_that_exist(self):
        for row in rows("promises.tsv"):
            for test in re.split(r"; (?=tests/|scripts/)", row["TEST"]):
                with self.subTest(row["PHRASE"]):
                    self.assertTrue(has_test(test), f"there is no {test}")

    def test_each_sentence_that_promises_is_listed(self):
        listed = rows("promises.tsv") + rows("descriptions.tsv")
        for document in DOCUMENTS:
            phrases = [row["PHRASE"] for row in listed if row["DOCUMENT"] == document]
            for sentence in filter(PROMISE.search, sentences(read(document))):
                with self.subTest(document):
                    self.assertTrue(any(phrase in sentence for phrase in phrases),
                                    f"name its test in promises.tsv, or list it in descriptions.tsv: {sentence}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
