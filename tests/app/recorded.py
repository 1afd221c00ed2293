# Drives the editor without a display, with the same verbs as driver.Editor. Time passes only when a test says so.
import json
import subprocess
import threading
import time

from verbs import Session, Verbs

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
# GLFW's codes of the keys that xdotool calls by these names.
CODES = dict({c: ord(c) for c in LETTERS}, **{c.lower(): ord(c) for c in LETTERS})
CODES |= {"space": 32, "apostrophe": 39, "comma": 44, "minus": 45, "period": 46, "slash": 47, "semicolon": 59, "equal": 61,
          "bracketleft": 91, "backslash": 92, "bracketright": 93, "grave": 96, "Escape": 256, "Return": 257, "Tab": 258,
          "BackSpace": 259, "Insert": 260, "Delete": 261, "Right": 262, "Left": 263, "Down": 264, "Up": 265,
          "Page_Up": 266, "Page_Down": 267, "Home": 268, "End": 269, "KP_Enter": 335,
          "shift": 340, "ctrl": 341, "alt": 342, "super": 343, "Shift_L": 340, "Control_L": 341, "Alt_L": 342}
CODES |= {f"F{i}": 289 + i for i in range(1, 13)}
SHIFTED = dict(zip('!@#$%^&*()_+{}|:"<>?~', "1234567890-=[]\\;',./`"))
NAMED = {"question": "?", "plus": "+", "asterisk": "*", "underscore": "_", "colon": ":"}
PLAIN = {"space": " ", "apostrophe": "'", "comma": ",", "minus": "-", "period": ".", "slash": "/", "semicolon": ";", "equal": "=",
         "bracketleft": "[", "backslash": "\\", "bracketright": "]", "grave": "`"}
MODIFIERS = {340: 1, 341: 2, 342: 4, 343: 8}
RELEASE, PRESS = 0, 1
BUTTONS = {1: 0, 2: 2, 3: 1}


class RecordedEditor(Verbs, Session):
    def __init__(self, program, arguments=(), size="1280x800", home=None):
        super().__init__(home)
        width, height = size.split("x")
        self.process = subprocess.Popen([program, width, height, *arguments], env=self.environment, cwd=self.folder, text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log)
        self.held = 0
        self.now = None
        self.answer()

    def __exit__(self, *_):
        super().__exit__()
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass  # events were left over for an editor that had ended
        self.process.stdout.close()

    def answer(self):
        watch = threading.Timer(120, self.process.kill)  # an editor that never waits for input
        watch.start()
        line = self.process.stdout.readline()
        watch.cancel()
        if line:
            self.now = json.loads(line)
        else:
            self.process.wait()

    def send(self, *events):
        """Sends events and takes the editor's state once it waits for more."""
        try:
            self.process.stdin.write(json.dumps(events) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass
        self.answer()

    def state(self):
        return self.now

    def pause(self, seconds):
        self.send(["pass", seconds])

    def wait(self, condition, what, seconds=40):
        """Lets time pass until the state satisfies a condition and the map is ready."""
        end = time.time() + seconds
        while True:
            if self.process.poll() is not None:
                raise AssertionError(f"the program ended with {self.process.returncode} while waiting for {what}: " + self.messages())
            if condition(self.now) and not self.now["busy"]:
                return self.now
            if time.time() > end:
                raise AssertionError(f"timed out while waiting for {what}; the state is {self.now}; " + self.messages())
            self.pause(0.05)

    def xdotool(self, *words, pause=0.12):
        """Understands the words of xdotool that the tests use."""
        words = list(map(str, words))
        events, times = [], 1
        while words:
            verb = words.pop(0)
            while verb in ("click", "key", "keydown", "keyup") and words and words[0].startswith("--"):
                option = words.pop(0)
                if option != "--clearmodifiers":
                    value = words.pop(0)
                    times = int(value) if option == "--repeat" else times
            if verb == "mousemove":
                events.append(["move", float(words.pop(0)), float(words.pop(0))])
            elif verb in ("mousedown", "mouseup"):
                events.append(["button", BUTTONS[int(words.pop(0))], verb == "mousedown"])
            elif verb == "click":
                button = int(words.pop(0))
                if button in (4, 5):
                    events += times * [["scroll", 1 if button == 4 else -1]]
                else:
                    events += times * [["button", BUTTONS[button], True], ["button", BUTTONS[button], False]]
            elif verb == "key":
                events += self.pressed(words.pop(0))
            else:
                assert verb in ("keydown", "keyup"), verb
                code = CODES[words.pop(0)]
                bit = MODIFIERS.get(code, 0)
                self.held = self.held | bit if verb == "keydown" else self.held & ~bit
                events.append(["key", code, PRESS if verb == "keydown" else RELEASE, self.held])
        self.send(*events)
        self.settle(pause)

    def settle(self, seconds):
        """Lets time pass, and waits for the map."""
        self.pause(seconds)
        self.wait_while("busy")

    def ready(self):
        """Waits until the pointer can act: until the map is solved, and no work covers the window with its progress."""
        self.wait_while("exporting")
        self.wait_while("busy")

    def wait_while(self, what):
        most = 4000  # steps, of 6 ms or more
        while self.now[what] and most > 0 and self.process.poll() is None:
            self.pause(0.05)
            most -= 1

    def pressed(self, name):
        """The events of a key combination such as ctrl+shift+z. Like xdotool, adds Shift if the character needs it."""
        *modifiers, key = name.split("+") if name != "+" else ["plus"]
        character = NAMED.get(key, PLAIN.get(key, key if len(key) == 1 else ""))
        if character in SHIFTED:
            modifiers, code = [*modifiers, "shift"], ord(SHIFTED[character])
        else:
            code = CODES[key]
            if len(key) == 1 and key.isupper():
                modifiers = [*modifiers, "shift"]
        codes = [CODES[m] for m in modifiers]
        mods = self.held
        events = []
        for each in codes:
            mods |= MODIFIERS[each]
            events.append(["key", each, PRESS, mods])
        events.append(["key", code, PRESS, mods])
        if character and not mods & 14:
            events.append(["character", ord(character.upper() if mods & 1 and character.isalpha() else character)])
        events.append(["key", code, RELEASE, mods])
        for each in reversed(codes):
            mods &= ~MODIFIERS[each]
            events.append(["key", each, RELEASE, mods])
        return events

    def move(self, x, y):
        self.ready()
        self.xdotool("mousemove", *self.pixel(x, y), pause=0.02)

    def press(self, x, y, button=1):
        self.ready()
        self.xdotool("mousemove", int(x), int(y))
        self.xdotool("click", button)

    def item(self, name, seconds=10):
        """The window position of the middle of a named item. Lets time pass until it stays in place."""
        before = None
        for _ in range(int(10 * seconds)):
            box = self.now["items"].get(name) if not self.now["moving"] else None
            if box and box == before:
                return (box[0] + box[2]) // 2, (box[1] + box[3]) // 2
            before = box
            self.pause(0.05)
        raise AssertionError(f"there is no item '{name}'; the items are {sorted(self.now['items'])}")

    def drop(self, path, x, y):
        self.send(["move", x, y], ["drop", path])
        self.settle(0.12)

    def key(self, name):
        self.send(*self.pressed(name))
        self.settle(0.05)

    def type(self, text):
        names = {character: name for name, character in PLAIN.items()}
        for character in text:
            if ord(character) < 128:
                self.send(*self.pressed(names.get(character, character)))
            else:
                self.send(["character", ord(character)])
