# Drives the real program on a virtual display with real input events.
import json
import os
import subprocess
import sys
import time

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from verbs import Session, Verbs  # noqa: E402


class Display(Session):
    """A virtual display, and a program on it."""

    def __init__(self, size="1400x900", home=None):
        super().__init__(home)
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", size + "x24", "-nolisten", "tcp"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):
            number += os.read(read, 16)
        os.close(read)
        self.environment |= {"DISPLAY": ":" + number.decode().strip(), "LIBGL_ALWAYS_SOFTWARE": "1",
                             "ASAN_OPTIONS": "detect_leaks=0"}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def run(self, *command):
        self.process = subprocess.Popen(command, env=self.environment, stdout=self.log, stderr=self.log, cwd=self.folder)

    def screenshot(self, path):
        subprocess.run(["import", "-window", "root", path], env=self.environment, check=True)

    def __exit__(self, *_):
        super().__exit__()
        self.server.kill()
        self.server.wait()


class Editor(Verbs, Display):
    """The editor on a display. `program` writes its state into a file (real_editor.cpp)."""

    def __init__(self, program, arguments=(), size="1400x900", home=None, settles=True):
        super().__init__(size, home)
        self.state_path = self.folder + "/state.json"
        self.run(program, *arguments, "--state", self.state_path)
        if settles:
            self.wait(lambda s: s is not None, "the first frame", 30)
        while not settles and self.state() is None:
            time.sleep(0.005)

    def state(self):
        try:
            with open(self.state_path) as file:
                return json.load(file)
        except (FileNotFoundError, json.JSONDecodeError):
            return None

    def wait(self, condition, what, seconds=40):
        """Waits until the state satisfies a condition and the map is ready."""
        end = time.time() + seconds
        while time.time() < end:
            if self.process.poll() is not None:
                raise AssertionError(f"the program ended with {self.process.returncode} while waiting for {what}: " + self.messages())
            state = self.state()
            if condition(state) and (state is None or not state["busy"]):
                return state
            time.sleep(0.03)
        raise AssertionError(f"timed out while waiting for {what}; the state is {self.state()}; " + self.messages())

    def pause(self, seconds):
        time.sleep(seconds)

    def xdotool(self, *words, pause=0.12):
        """Sends input events, and waits until the window has drawn what moves and buttons change."""
        since = self.taken()
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)
        time.sleep(pause)
        position = list(map(int, words[1:])) if words[0] == "mousemove" and len(words) == 3 else None
        self.settle(since, words.count("mousedown") + words.count("mouseup"), position)

    def move(self, x, y):
        self.xdotool("mousemove", *self.pixel(x, y))

    def press(self, x, y, button=1):
        """Clicks at a window position."""
        self.xdotool("mousemove", int(x), int(y))
        since = self.taken()
        self.xdotool("click", button, pause=0)
        self.settle(since, 2)

    def item(self, name, seconds=10):
        """The window position of the middle of a named item, such as a button. Waits until the item stays in place."""
        end, before = time.time() + seconds, None
        while time.time() < end:
            state = self.state()
            box = state["items"].get(name) if state and not state["moving"] else None
            if box and box == before:
                return (box[0] + box[2]) // 2, (box[1] + box[3]) // 2
            before = box
            time.sleep(0.1)
        raise AssertionError(f"there is no item '{name}'; the items are {sorted((self.state() or {'items': {}})['items'])}")

    def drop(self, path, x, y):
        """Drops a file on the window as a file manager does (the XDND protocol, version 5)."""
        from Xlib import X, Xatom
        from Xlib.display import Display
        from Xlib.protocol import event
        self.xdotool("mousemove", x, y)
        display = Display(self.environment["DISPLAY"])
        root = display.screen().root
        source = root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        atom = display.intern_atom
        pid = self.process.pid
        found = subprocess.run(["xdotool", "search", "--pid", str(pid), "--name", "Holomorph"],
                               env=self.environment, check=True, capture_output=True, text=True).stdout.split()
        target = display.create_resource_object("window", int(found[-1]))
        source.set_selection_owner(atom("XdndSelection"), X.CurrentTime)

        def send(name, *data):
            target.send_event(event.ClientMessage(window=target, client_type=atom(name),
                                                  data=(32, [source.id, *data, *[0] * (4 - len(data))])))
            display.flush()

        def answer(name, seconds=5):
            """The window's next message with this name. Answers selection requests while it waits."""
            end = time.time() + seconds
            while time.time() < end:
                if not display.pending_events():
                    time.sleep(0.01)
                    continue
                got = display.next_event()
                if got.type == X.SelectionRequest:
                    got.requestor.change_property(got.property, got.target, 8, ("file://" + path + "\r\n").encode())
                    got.requestor.send_event(event.SelectionNotify(
                        time=got.time, requestor=got.requestor, selection=got.selection, target=got.target,
                        property=got.property))
                    display.flush()
                elif got.type == X.ClientMessage and got.client_type == atom(name):
                    return got
            raise AssertionError(f"the window did not send {name}")

        send("XdndEnter", 5 << 24, atom("text/uri-list"), 0, 0)
        send("XdndPosition", 0, x << 16 | y, X.CurrentTime, atom("XdndActionCopy"))
        answer("XdndStatus")
        send("XdndDrop", 0, X.CurrentTime)
        answer("XdndFinished")
        display.close()

    def taken(self):
        """How many presses and releases of keys and buttons the window has handled; 0 if it has not written its state yet."""
        return (self.state() or {"taken": 0})["taken"]

    def settle(self, since, changes, position=None):
        """Waits until the window has handled `changes` more presses and releases than `since`, none are pending, and
        the pointer is at `position`. Each press or release takes a frame, and slow machines draw few frames. Gives up
        after 10 s, in case another window got the input."""
        end = time.time() + 10
        while time.time() < end and self.process.poll() is None:
            state = self.state()
            arrived = state and (not position or state["pointer"] == position)
            if arrived and not state["pending"] and state["taken"] >= since + changes:
                return
            time.sleep(0.02)

    def key(self, name):
        since = self.taken()
        self.xdotool("key", "--clearmodifiers", name, pause=0)
        self.settle(since, 2 * len(name.split("+")))

    def type(self, text):
        since = self.taken()
        self.xdotool("type", "--delay", "15", text, pause=0)
        self.settle(since, 2 * len(text))
