# Tests of the first minutes in the real window: few actions to a bent picture, methods that are easy to change, panels
# that stay in place.
import os
import sys
import time

sys.path.insert(0, os.path.dirname(__file__))
from case import PROGRAM, SOURCE, WindowCase, load, run_tests  # noqa: E402
from driver import Editor  # noqa: E402

BODY, LEG, HEAD = (600, 410), (800, 668), (250, 270)  # on the gecko


class ProductWindowTest(WindowCase):
    def saved(self, editor, name):
        path = os.path.join(self.work, name)
        self.save_as(editor, path)
        return load(path)

    def test_four_actions_bend_a_picture(self):
        with Editor(PROGRAM, []) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.drop(self.picture, 700, 500)
            editor.wait(lambda s: s["pictured"] and s["tool"] == "pin", "the dropped picture and the pin tool")
            time.sleep(0.5)
            editor.click(*BODY)
            editor.wait(lambda s: s["pins"] == 1 and s["method"] == "puppet", "a pin in a puppet")
            editor.click(*LEG)
            editor.wait(lambda s: s["pins"] == 2, "a second pin")
            editor.drag(HEAD, (250, 330))
            state = editor.wait(lambda s: s["pins"] == 3 and not s["gesture"], "a third pin")
            self.assertFalse(state["folds"])
            self.screenshot(editor, "four-actions")
            pins = self.saved(editor, "bent.json")["pins"]
        for pin, place in zip(pins, (BODY, LEG, HEAD)):
            self.assertLess(abs(pin["rest"][0] - place[0]) + abs(pin["rest"][1] - place[1]), 6, "pins lie where they were pressed")
        self.assertEqual([pin.get("pose", pin["rest"]) == pin["rest"] for pin in pins], [True, True, False])
        self.assertGreater(pins[2]["pose"][1] - pins[2]["rest"][1], 45, "the drag moves the pin that its press has set")

    def test_ctrl_drags_the_radius_of_the_held_disk(self):
        with Editor(PROGRAM, [os.path.join(SOURCE, "assets", "gecko.json")]) as editor:
            state = editor.wait(lambda s: s["status"] == "certified", "the map")
            place = (600, 415)  # the pin with a rotation
            ring = 34 * state["scale"] / state["zoom"]
            editor.click(*place)
            editor.wait(lambda s: s["selected"] == 1, "a selected pin")
            self.screenshot(editor, "held-disk")
            editor.xdotool("keydown", "ctrl")
            editor.drag((place[0] + ring, place[1]), (place[0] + ring + 60, place[1]))
            editor.xdotool("keyup", "ctrl")
            editor.wait(lambda s: s["modified"] and not s["gesture"], "a larger disk")
            self.screenshot(editor, "larger-held-disk")
            pin = self.saved(editor, "disk.json")["pins"][0]
            self.assertGreater(pin["radius"], 80)
            self.assertEqual(pin["angle"], 0.05, "the rotation stays")

    def test_a_change_of_the_method_keeps_the_handles(self):
        with Editor(PROGRAM, [self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            for place in (BODY, LEG):
                editor.click(*place)
            editor.drag(HEAD, (250, 330))
            editor.wait(lambda s: s["pins"] == 3 and not s["gesture"], "three pins")
            before = self.saved(editor, "puppet.json")
            editor.press_item("Elastic")
            editor.wait(lambda s: s["method"] != "puppet", "another method")
            time.sleep(0.3)
            self.screenshot(editor, "elastic")
            after = self.saved(editor, "elastic.json")
            for old, new in zip(before["pins"], after["pins"]):
                for a, b in zip(old.get("pose", old["rest"]), new.get("pose", new["rest"])):
                    self.assertLess(abs(a - b), 1)
            free = editor.state()["method"]
            editor.press_item("Prevent folds")
            editor.wait(lambda s: s["method"] == "bounded", "a map without folds")
            method = self.saved(editor, "proved.json")["method"]
            self.assertEqual(method["parameters"]["reference"], free, "the switch keeps what the card has chosen")
            editor.press_item("Prevent folds")
            editor.wait(lambda s: s["method"] == free, "the method without the switch")
            editor.press_item("Puppet")
            editor.wait(lambda s: s["method"] == "puppet", "the puppet again")

    def test_panels_stay_in_place(self):
        with Editor(PROGRAM, [self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")

            def places():
                time.sleep(0.4)
                state = editor.state()
                names = [name for name in state["items"] if name.startswith(("section ", "tool.", "layer.", "view."))]
                return {name: state["items"][name] for name in names} | {
                    "canvas": [state[key] for key in ("left", "top", "width", "height")]}
            editor.click(*BODY)
            editor.wait(lambda s: s["pins"] == 1, "a pin")
            editor.wait(lambda s: not s["moving"], "rest")
            before = places()
            self.assertGreater(len(before), 15)
            editor.click(*LEG)
            editor.wait(lambda s: s["pins"] == 2, "another pin")
            self.assertEqual(places(), before, "another pin")
            editor.key("Escape")
            self.assertEqual(places(), before, "nothing selected")
            for tool in ("tool.select", "tool.brush", "tool.pen", "tool.stroke", "tool.pin"):
                editor.press_item(tool)
                self.assertEqual(places(), before, tool)


if __name__ == "__main__":
    run_tests()
