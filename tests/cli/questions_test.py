"""`fusee new --ask`: answers become a file that builds; invalid answers are asked again; an input that ends leaves no file."""

import math
import os
import pty
import random
import re
import select
import signal
import struct
import subprocess
import time
import tomllib
import unittest

import harness

QUESTIONS = 7


def answers(name="joint", length="45 mm", span="0 80", room="30 mm", load="10 N", motor="n20-d3", tendon="0.6"):
    return "\n".join((name, length, span, room, load, motor, tendon)) + "\n"


class Questions(harness.Scratch):
    def ask(self, typed, code=0, words="new --ask"):
        done = self.fusee(words, input=typed.encode() if isinstance(typed, str) else typed)
        self.assertEqual(done.returncode, code, done.stderr.decode(errors="replace"))
        return done.stdout.decode(), done.stderr.decode(errors="replace")

    def understood(self, *lines):
        """How the answers `lines` were understood, and stderr. The input ends after them."""
        out, err = self.ask("\n".join(lines) + "\n", 3)
        self.assertEqual(out, "")
        return re.search(r"answered: (.*)", err)[1], err

    def builds(self, text, room=None):
        """The build's document; the pulley is at most `room` mm wide."""
        (self.folder / "asked.toml").write_text(text)
        document = self.expect_json("build asked.toml --force", 0)
        self.assertTrue(all(check["ok"] for check in document["checks"]))
        if room:
            # A binary STL: 84 bytes of header and count, then facets of a normal (skipped), three corners and an attribute.
            mesh = (self.folder / "out/asked/pulley.stl").read_bytes()[84:]
            facets = struct.iter_unpack("<12x9fxx", mesh)
            reach = max(math.hypot(*facet[i:i + 2]) for facet in facets for i in (0, 3, 6))
            self.assertLessEqual(2 * reach, room + 0.001)
        return document

    def test_proposals_build(self):
        text, asked = self.ask("\n" * QUESTIONS)
        self.assertRegex(text, r"(?m)^length_mm = 60$")
        self.assertRegex(text, r"(?m)^range_deg = \[-30, 30\]")
        self.assertEqual([f"{n}/{QUESTIONS} " in asked for n in range(1, QUESTIONS + 1)], [True] * QUESTIONS)
        self.assertIn("a lever", asked)
        self.builds(text, 42)

    def test_file_has_answers(self):
        text, _ = self.ask(answers('a "left" finger', "32", "-15, 45", "30", "12.5", "n20-d3", "0.56"))
        for line in ('name = "a \\"left\\" finger"', "length_mm = 32", "range_deg = [-15, 45]", "diameter_mm = 0.56",
                     "tip_force_N = 12.5", 'shaft = "n20-d3"'):
            self.assertIn("\n" + line + "\n", text)
        self.builds(text, 30)

    def test_wide_ranges_get_a_drum(self):
        for span, length in (("0 80", "45"), ("±60", "250"), ("-180 180", "60"), ("-150 0", "100")):
            text, asked = self.ask(answers(length=length, span=span, room="60", motor="nema17-d5", tendon="1 mm"))
            self.assertIn("a drum on the joint", asked)
            self.assertIn("drum_radius_mm", text)
            self.builds(text, 60)

    def test_heavy_load_gets_multi_turn_pulley(self):
        text, asked = self.ask(answers(length="250", span="±60", room="40", load="50 N", motor="nema17-d5", tendon="1"))
        self.assertIn("several turns", asked)
        self.assertIn('kind = "idler"', text)
        self.builds(text, 40)

    def test_servo_turns_no_further_than_it_can(self):
        text, _ = self.ask(answers(length="110", span="-40 30", room="60", load="20 N", motor="MG996R horn", tendon="1"))
        alpha = self.builds(text, 60)["alpha_deg"]
        self.assertLessEqual(alpha[1] - alpha[0], 180)

    def test_lengths_are_understood(self):
        for typed, length in (("45 mm", "45 mm"), ("4.5 cm", "45 mm"), ("4,5 cm", "45 mm"), ("1.8 in", "1.8 in"), ('1.8"', "1.8 in"),
                              ('1 3/4"', "1.75 in"), ("0.5 m", "500 mm"), ("0.5 metres", "500 mm"), ("2 ft 3 in", "27 in")):
            self.assertIn(f"length: {length}", self.understood("a", typed)[0], typed)

    def test_ranges_are_understood(self):
        for typed in ("±30", "+-30", "+/-30", "-30..30", "-30 to 30", "[-30, 30]", "−30° … 30°", "-30 30 deg"):
            self.assertIn("range: -30 to 30 deg", self.understood("a", "45", typed)[0], typed)
        for typed in ("0..80", "0 80", "0-80", "0 to 80", "0,80"):
            self.assertIn("range: 0 to 80 deg", self.understood("a", "45", typed)[0], typed)
        self.assertIn("range: -15.5 to 30.5 deg", self.understood("a", "45", "-15,5 30,5")[0])

    def test_loads_are_understood(self):
        for typed, load in (("10 N", "10 N at C"), ("0,5 kg", "4.903 N at C"), ("500 g", "4.903 N at C"), ("2 lbf", "8.896 N at C"),
                            ("0.8 Nm", "800 Nmm about O"), ("5 kg cm", "490.3 Nmm about O"), ("8 lb-in", "903.9 Nmm about O"),
                            ("1 lb ft", "1356 Nmm about O")):
            self.assertIn(f"load: {load}", self.understood("a", "45", "0 80", "30", typed)[0], typed)

    def test_motors_and_tendons_are_found_by_name(self):
        begun = ("a", "45", "0 80", "30", "10 N")
        for typed, motor in (("N20", "N20 gear motor"), ("small N20 gear motor", "N20 gear motor"), ("MG996R horn", "turns 180 deg"), ("dynamixel XL330", "horn of Dynamixel XL330"),
                             ("5 mm D", "a D shaft of 5 mm"), ("1/4 in", "a round shaft of 6.35 mm")):
            self.assertIn(motor, self.understood(*begun, typed)[0], typed)
        for typed, modulus in (("Dyneema 0.6", 40000), ("0.6 mm Spectra", 40000), ("Vectran 0.6", 25000), ("nylon 0.6 mm", 2000),
                               ("braided steel wire 0.6", 57300)):
            text, _ = self.ask(answers(room="60", tendon=typed))
            tendon = tomllib.loads(text)["tendon"]
            self.assertEqual((tendon["diameter_mm"], tendon["modulus_MPa"]), (0.6, modulus))
        for typed, strength in (("Dyneema 0.6", 511), ("Vectran 0.6", 324), ("hmpe-0.56", None)):
            text, _ = self.ask(answers(room="60", tendon=typed))
            self.assertEqual(tomllib.loads(text)["tendon"].get("strength_N"), strength, typed)

    def test_family_of_shafts_takes_the_usual_one(self):
        begun = ("a", "45", "0 80", "30", "10 N")
        for typed, name, other in (("NEMA 17", "nema17-d5", "nema17-round5"), ("nema-17 stepper", "nema17-d5", "nema17-round5"),
                                   ("NEMA 17, 5 mm shaft", "nema17-d5", "nema17-round5"), ("NEMA 23", "nema23-round6.35", "nema23-d6.35"),
                                   ("8 mm stepper", "round8", "d8")):
            self.assertIn(f" ({name}; also in the list: {other})", self.understood(*begun, typed)[0], typed)
        self.assertNotIn("also in the list", self.understood(*begun, "NEMA 17 round")[0])
        self.assertIn('"stepper" fits several entries', self.understood(*begun, "stepper", "5 mm")[1])  # of three diameters
        text, _ = self.ask(answers(room="60", motor="NEMA 17"))
        self.assertIn('shaft = "nema17-d5"', text)
        self.assertIn("Motor: NEMA 17 stepper, D shaft.", text.replace("\n# ", " "))

    def test_pulley_keeps_its_features_where_there_is_room(self):
        # With 2 N an N20 needs no reduction; with 5 N it needs a pulley with the smallest set screw only.
        for length, span, room, load, motor in (("45", "0 80", "30", "2 N", "n20-d3"), ("45", "0 80", "25", "2 N", "n20-d3"),
                                                ("60", "-45 45", "30", "5 N", "5 mm D"), ("40", "±90", "40", "5 N", "nema17-d5"),
                                                ("30", "0 90", "30", "5 N", "3 mm")):
            text, _ = self.ask(answers(length=length, span=span, room=room, load=load, motor=motor))
            self.builds(text, float(room))
            notes = self.expect("build asked.toml --dry-run", 0).stderr.decode()
            for feature in ("set screw omitted", "no hub", "home mark"):
                self.assertNotIn(feature, notes, (length, span, room, motor))

    def test_invalid_answers_are_repeated(self):
        typed = ["arm", "sixty", "-3", "60 70", "60", "30 -30", "10 30", "30", "-20 20", "30 apples", "40", "3 bananas", "10", "MG996R", "foo",
                 "5 mm", "Dyneema", "1"]
        text, asked = self.ask("\n".join(typed) + "\n")
        for words in ('"sixty" is not a length', '"-3" is not a length', '"60 70" is not a length', "the lower end comes first: -30 30?",
                      "home, at 0", "give both ends", '"30 apples" is not a length', '"bananas" is not a unit',
                      "disc-25T-M3, spline-25T-mg996r. Which one?", '"foo" is neither', "give its diameter too"):
            self.assertIn(words, asked)
        self.assertIn("range_deg = [-20, 20]", text)
        self.assertIn("length_mm = 60", text)

    def test_input_that_ends_leaves_no_file(self):
        for count in range(QUESTIONS):
            out, err = self.ask("".join(answers().splitlines(keepends=True)[:count]), 3)
            self.assertEqual(out, "")
            self.assertIn(f"the input ended at question {count + 1} of {QUESTIONS}", err)
        self.builds(self.ask(answers().rstrip("\n"))[0])  # the last line needs no line break

    def test_gives_up_after_invalid_answers(self):
        for typed in (b"a\n" + b"nonsense\n" * 1000, bytes(1_000_000), b"a\n" + b"9" * 1_000_000):
            out, err = self.ask(typed, code=3)
            self.assertEqual(out, "")
            self.assertIn("no usable answer in 50 tries", err)

    def test_inches_make_a_file_in_inches(self):
        for words, length, room, tendon in (("new --ask", "1.8 in", '1 1/4"', "0.024 in"), ("new --ask --set units=inch", "1.8", "1.25", "0.024")):
            text, asked = self.ask(answers(length=length, room=room, tendon=tendon), words=words)
            read = tomllib.loads(text)
            self.assertEqual((read["units"], read["joint"]["length_mm"], read["tendon"]["diameter_mm"]), ("inch", 1.8, 0.024))
            self.assertIn("room 1.25 in", text.replace("\n# ", " "))
            self.assertIn("→ 1.25 in", asked)
            self.assertRegex(asked, r"0\.\d+ in wide")
            self.assertNotRegex(asked.split("[1 mm]: ")[1], r"\d mm")
            self.assertIn("C is 1.8 in above O", asked)
            self.assertNotRegex(text.split("schema")[1], r'= .*\d{6}|" mm')
            self.builds(text, 31.75)
        # A unit beside --set is read, but the file's unit is that of --set.
        self.assertNotIn("inch\"", self.ask(answers(length="1.8 in"), words="new --ask --set units=mm")[0])

    def test_motor_is_compared_with_the_load(self):
        text, asked = self.ask(answers("elbow", "250 mm", "±60", "80", "50 N", "nema17-d5", "2 mm"))
        if "warning: under the load" in asked:
            self.assertRegex(asked, r"hold \d+ Nmm: NEMA17-48mm, the strongest that fits the bore, has margin 0\.\d+, and 1 is advised")
            self.assertIn("suitable with another bore: ", asked)
        asked = self.ask(answers(length="60", span="±20", room="42", load="1 N", motor="disc-25T-M3", tendon="1"))[1]
        self.assertRegex(asked, r"note: under the load the motor has to hold [\d.]+ Nmm: suitable: ")

    def test_pretension_keeps_tendons_taut(self):
        for typed in (answers(load="5 N"), answers("wrist", "80", "±40", "45", "15 N", "MG996R horn", "1"), answers("elbow", "250", "±60", "80", "2 kg", "NEMA 17", "1")):
            text, _ = self.ask(typed)
            self.assertRegex(text, r"(?m)^# [\d.]+ N or more keeps both tendons taut under the load\npretension_N = [\d.]+$")
            document = self.builds(text)["under_load"]
            self.assertEqual((document["slack1"], document["slack2"]), ([], []), typed)
            self.assertIn('verdict good', (self.folder / "out/asked/report.html").read_text())
            # Without it a tendon is slack, and the page does not say that all is well.
            self.expect("build asked.toml --force -o slack --set tendon.pretension_N=0.5", 0)
            self.assertIn('verdict noted', (self.folder / "slack/report.html").read_text())

    def test_weak_motor_gets_a_larger_reduction(self):
        for words in ("new --ask", "new --ask --set motor.enforce=true"):
            text, asked = self.ask(answers("elbow", "250 mm", "±60", "240 mm", "2 kg", "NEMA17-48mm", "1 mm"), words=words)
            # Several turns are too high for the shaft. That is the only warning.
            self.assertEqual([words.split(":")[0] for words in re.findall("warning: (.*)", asked)], ["the shaft does not reach the set screw"])
            motor = self.builds(text, 240)["motor"]
            self.assertGreaterEqual(motor["torque"]["margin"], 1)
            self.assertLess(len(text.splitlines()), 90)
            self.assertEqual("enforce = true" in text, "enforce" in words)
        # A setting that suits the motor alone hides no obstacle.
        out, err = self.ask(answers("elbow", "250 mm", "±60", "12 mm", "20 kg", "NEMA17-48mm", "1 mm"), 4, "new --ask --set motor.enforce=true")
        self.assertIn("no layout fits these answers", err)
        self.assertNotIn("no limit to enforce", err)

    def test_drum_is_no_wider_than_room(self):
        for typed, room in ((answers(load="5 N"), 30), (answers(room="20"), 20), (answers("elbow", "250", "±60", "60", "2 kg", "NEMA17-48mm 5:1", "1"), 60)):
            joint = tomllib.loads(self.ask(typed)[0])
            self.assertLessEqual(2 * (joint["joint"]["drum_radius_mm"] + joint["tendon"]["diameter_mm"]), room, typed)
        # If the motor is too weak for such drums, the reply names the room that suffices.
        elbow = answers("elbow", "250", "±60", "80", "2 kg", "NEMA17-48mm", "1")
        asked = self.ask(elbow)[1]
        self.assertIn("warning: the motor NEMA17-48mm holds 590 Nmm, and the load requires", asked)
        room = re.search(r"the motor holds the load with a drum of ([\d.]+) mm radius \(now ([\d.]+) mm\) and a pulley ([\d.]+) mm wide and ([\d.]+) mm high "
                         r"\(now ([\d.]+) mm and ([\d.]+) mm\).*: try ([\d.]+) mm in place of 80 mm for question 4 \(room\)", asked)
        self.assertTrue(room, asked)
        self.assertEqual(self.sizes(elbow), room.group(2, 5, 6))
        self.assertEqual(self.sizes(elbow.replace("\n80\n", f"\n{room[7]}\n")), room.group(1, 3, 4))
        self.assertIn(f"try {room[7]} mm in place of 80 mm for question 4", self.ask(elbow, 4, "new --ask --set motor.enforce=true")[1])
        self.assertNotIn("warning: the motor", self.ask(elbow.replace("\n80\n", f"\n{room[7]}\n"))[1])

    def sizes(self, typed):
        """Drum radius, and the pulley's width and height, of these answers, with three digits."""
        text = self.ask(typed)[0]
        size = self.builds(text)["size_mm"]
        return tuple(f"{value:.3g}" for value in (tomllib.loads(text)["joint"]["drum_radius_mm"], size["diameter"], size["height"]))

    def test_pulley_is_held_on_its_shaft(self):
        # A pulley of several turns is smaller, and has no space for a hub with a set screw.
        for load, costs_torque in (("5 N", False), ("7 N", False), ("10 N", True), ("12 N", True)):
            text, asked = self.ask(answers(load=load))
            self.builds(text, 30)
            self.assertNotIn("set screw omitted", self.expect("build asked.toml --dry-run", 0).stderr.decode(), load)
            self.assertEqual("the set screw costs torque: a smaller pulley without one would require " in asked, costs_torque, load)
            self.assertEqual("the set screw costs torque" in text.replace("\n# ", " "), costs_torque)
            self.assertRegex(asked, r"has margin 1\.\d+, and 2 is advised|suitable: N20")
        # No set screw fits this room.
        asked = self.ask(answers(room="9 mm", load="0.5 N"))[1]
        self.assertIn("warning: nothing holds the pulley on its shaft", asked)

    def test_set_screw_reaches_the_shaft(self):
        # An N20 has 10 mm of shaft: the hub of 8 mm, with the screw in its middle, is too high for it.
        text, asked = self.ask(answers("my finger", "38 mm", "0..75", "25 mm", "6 N", "N20", "braid 0.5"))
        self.assertNotIn("does not reach", asked)
        self.assertLess(tomllib.loads(text)["body"]["hub_height_mm"], 8)
        self.builds(text, 25)
        self.assertNotIn("does not reach", self.expect("build asked.toml --dry-run", 0).stderr.decode())
        found = re.search(r"asked.toml:\d+:\d+: warning: the shaft does not reach the set screw: M[\d.]+ at ([\d.]+) mm above the pulley's lower face "
                          r"requires ([\d.]+) mm of shaft, and the shaft of N20 is 10 mm long\n  hint: try body.hub_height_mm = ([\d.]+) \(now 8\)",
                          self.expect("build asked.toml --set body.hub_height_mm=8 -o high", 0).stderr.decode())
        self.assertTrue(found)
        self.assertGreater(float(found[2]), float(found[1]))
        self.assertGreater(float(found[2]), 10)
        self.assertIn("the shaft of N20 is 10 mm long", (self.folder / "high/report.html").read_text())
        self.assertNotIn("does not reach", self.expect(f"build asked.toml --dry-run --set body.hub_height_mm={found[3]}", 0).stderr.decode())
        # The plate of a kit takes 4 mm of it.
        words = "the shaft does not reach the set screw: .* mm above the motor's face \\(4 mm of it below the pulley\\).*coupling"
        self.expect("kit asked.toml -o kit", 0, "", "warning: " + words)
        self.assertRegex((self.folder / "kit/kit.html").read_text().replace("&#39;", "'"), words)

    def test_several_turns_are_too_high_for_a_shaft(self):
        text, asked = self.ask(answers("elbow", "250 mm", "±60", "240 mm", "2 kg", "NEMA17-48mm", "1 mm"))
        found = re.search(r"warning: the shaft does not reach the set screw: .* at ([\d.]+) mm above the pulley's lower face .* NEMA 17 is 24 mm long", asked)
        self.assertTrue(found, asked)
        self.assertGreater(float(found[1]), 24)

    def test_refusal_names_least_torque_of_layouts(self):
        out, err = self.ask(answers(load="20 N", motor="N20-298-LP"), 4, "new --ask --set motor.enforce=true")
        self.assertEqual(out, "")
        found = re.search(r"N20-298-LP stalls at [\d.]+ Nmm, and the load requires ([\d.]+) Nmm .*, the least of the \d layouts", err)
        self.assertTrue(found, err)
        # Without the limit, the choice requires no less.
        self.ask(answers(load="20 N", motor="N20-298-LP"))
        chosen = self.ask(answers(load="20 N"))[1]
        self.assertLessEqual(float(found[1]), float(re.search(r"motor has to hold ([\d.]+) Nmm", chosen)[1]) * 1.01)

    def test_travel_is_of_the_motor_before_its_gearbox(self):
        begun = ("a", "250", "±60", "80", "2 kg")
        self.assertIn("turns the pulley 180 deg", self.understood(*begun, "NEMA17-48mm 5:1, 8 mm D, 900 deg")[0])
        for words, motor in (("new --ask", "NEMA17-48mm 5:1, 8 mm D, 900 deg"),
                             ("new --ask --set motor.travel_deg=900", "NEMA17-48mm 5:1, 8 mm D"),
                             ("new --ask --set motor.travel_deg=900 --set motor.gear_ratio=5", "NEMA17-48mm")):
            text, _ = self.ask(answers("elbow", "250", "±60", "80", "2 kg", motor, "1"), words=words)
            self.assertEqual(tomllib.loads(text)["motor"]["travel_deg"], 900)
            document = self.builds(text, 80)
            self.assertLessEqual(document["alpha_deg"][1] - document["alpha_deg"][0], 180)
            self.assertEqual(document["motor"]["travel"]["limit_deg"], 180)
            analysis = self.expect_json("analyze asked.toml", 0)
            self.assertEqual(analysis["motor"]["travel"]["limit_deg"], 180)

    def test_model_is_accepted_with_its_shaft(self):
        begun = ("a", "250", "±60", "80", "2 kg")
        for typed, words in (("NEMA17-40mm, 5 mm D", "NEMA17-40mm, NEMA 17 stepper, D shaft (nema17-d5)"),
                             ("NEMA17-40mm 5 mm round shaft", "NEMA17-40mm, NEMA 17 stepper, round shaft (nema17-round5)"),
                             ("NEMA17-40mm, 6 mm D", "NEMA17-40mm, a D shaft of 6 mm")):
            self.assertIn("motor: " + words, self.understood(*begun, typed)[0], typed)
        text, asked = self.ask(answers(load="2 N", room="40", motor="NEMA17-40mm, 5 mm D"))
        read = tomllib.loads(text)
        self.assertEqual((read["motor"], read["body"]["shaft"]), ({"model": "NEMA17-40mm"}, "nema17-d5"))

    def test_every_model_is_accepted_or_has_a_remedy(self):
        begun = ("a", "45", "0 80", "30", "10 N")
        listed = self.expect("explain motor.model", 0).stdout.decode().split("default")[0]
        models = [name for name in re.findall(r'"([^"]+)"', listed) if name != "none"]
        self.assertIn("STS3032", models)
        for model in models:
            answered, err = self.understood(*begun, model)
            if f", motor: {model}, " in answered:
                continue
            if several := re.search(r'" fits several entries: (\S+), .* Which one\?', err):  # a servo with several horns
                self.assertIn(", motor: ", self.understood(*begun, f"{model}, {several[1]}")[0])
                continue
            self.assertIn(f"the catalogue has neither horn nor shaft of {model}: type its shaft behind it, such as {model}, 5 mm D, "
                          f"or a horn of the list, such as {model}, disc-25T-M3", err)
            self.assertIn(f", motor: {model}, a D shaft of 5 mm", self.understood(*begun, f"{model}, 5 mm D")[0])
        for typed, words in (("STS3032, disc-25T-M3", "STS3032, aluminium disc"), ("N20 with encoder", "N20 gear motor"), ("N20 298:1", "N20-298-LP, "),
                             ("MG90S micro servo, 4 mm", "MG90S, a round shaft of 4 mm")):
            self.assertIn(f"motor: {words}", self.understood(*begun, typed)[0], typed)
        text, _ = self.ask(answers(load="1 N", motor="STS3032, 5 mm D"))
        self.assertEqual(tomllib.loads(text)["motor"], {"model": "STS3032"})
        self.builds(text, 30)

    def test_motor_of_the_answers_has_a_margin(self):
        for typed, limit in (("NEMA17-48mm 5:1, 8 mm D", "NEMA17-48mm 5:1 holds 2655 Nmm"), ("NEMA17-48mm", "NEMA17-48mm holds 590 Nmm")):
            _, asked = self.ask(answers("elbow", "250", "±60", "80", "0.1 kg", typed, "1"))
            self.assertRegex(asked, rf"note: under the load the motor has to hold [\d.]+ Nmm, and {limit} \(margin [\d.]+; 1 is advised\)")

    def test_gearbox_multiplies_torque(self):
        begun = ("a", "250", "±60", "80", "2 kg")
        self.assertIn("motor: NEMA17-48mm with a gearbox 5:1, a D shaft of 8 mm", self.understood(*begun, "NEMA17-48mm 5:1, 8 mm D")[0])
        self.assertIn("type the gearbox's shaft behind it", self.understood(*begun, "NEMA17-48mm geared 5:1")[0])
        self.assertIn("NEMA17-40mm, NEMA17-48mm. Which one?", self.understood(*begun, "NEMA17 5:1", "5 mm")[1])
        text, _ = self.ask(answers("elbow", "250", "±60", "80", "2 kg", "NEMA17-48mm 5:1, 8 mm D", "1"))
        read = tomllib.loads(text)
        self.assertEqual(read["motor"], {"model": "NEMA17-48mm", "gear_ratio": 5})
        self.assertEqual((read["body"]["bore"], read["body"]["bore_diameter_mm"]), ("d", 8))
        motor = self.builds(text, 80)["motor"]
        # Gear ratio, default efficiency of a gearbox, and the motor's holding torque, N mm.
        self.assertEqual((motor["model"], motor["torque"]["limit_Nmm"]), ("NEMA17-48mm 5:1", 5 * 0.9 * 590))
        self.assertRegex((self.folder / "out/asked/report.html").read_text(), "NEMA17-48mm 5:1")

    def test_room_is_kept(self):
        for typed, room in ((answers(load="5 N"), 30), (answers("elbow", "250", "±60", "60", "2 kg", "NEMA17-48mm", "1"), 60)):
            text, _ = self.ask(typed)
            read = tomllib.loads(text)
            self.assertEqual(read["body"]["room_diameter_mm"], room)
            self.builds(text, room)
            self.expect(f"build asked.toml --dry-run --set pulley.r1_mm={room / 2 + 1}", 4, "^$",
                        rf"the part is [\d.]+ mm wide, and its room \(body.room_diameter_mm\) is {room} mm")

    def test_settings_leave_file_short(self):
        text, _ = self.ask(answers(), words="new --ask --set body.min_wall_mm=1.5 --set print.supports=true")
        self.assertLess(len(text.splitlines()), 90)
        self.assertIn("\nmin_wall_mm = 1.5\n", text)
        self.assertIn("\nsupports = true\n", text)

    def test_motor_by_makers_name_is_in_file(self):
        for typed, motor, body in (("XL430-W250", {"model": "XL430-W250"}, ("horn", "dynamixel-xl430")),
                                   ("MG996R horn", {"model": "MG996R"}, ("horn", "disc-25T-M3")),
                                   ("hobby servo, 25-tooth horn, 180 deg", {"travel_deg": 180}, ("horn", "disc-25T-M3")),
                                   ("NEMA17-40mm", {"model": "NEMA17-40mm"}, ("shaft", "nema17-d5"))):
            text, _ = self.ask(answers(length="60", span="±20", room="42", load="1 N", motor=typed, tendon="1"))
            read = tomllib.loads(text)
            self.assertEqual((read["motor"], read["body"][body[0]]), (motor, body[1]), typed)
            self.builds(text, 42)

    def test_impossible_answers_name_an_answer_that_works(self):
        out, err = self.ask(answers(room="8 mm", motor="nema17-d5"), 4)
        self.assertEqual(out, "")
        other = re.search(r"try ([\d.]+ mm) in place of 8 mm for question 4", err)
        self.assertTrue(other, err)
        self.builds(self.ask(answers(room=other[1], motor="nema17-d5"))[0])
        # It may be typed when the question is asked again.
        text, _ = self.ask(answers(room="8 mm", motor="nema17-d5") + "\n")
        self.builds(text, float(other[1].split()[0]))

    def test_picture_has_pins_on_their_side(self):
        for span, above in (("-30 30", True), ("0 80", False)):
            text, asked = self.ask(answers(length="60", span=span, room="42", motor="5 mm", tendon="1"))
            picture = asked.split(f"{QUESTIONS}/{QUESTIONS}")[1].splitlines()
            row = {letter: next(i for i, line in enumerate(picture) if re.search(rf"(?<!\w){letter}(?!\w)", line[:44])) for letter in "BDOG"}
            self.assertEqual(row["B"], row["D"])
            self.assertEqual(row["B"] < row["O"], above)
            self.assertLess(row["O"], row["G"])
            self.assertEqual(tomllib.loads(text)["guides"]["OE_mm"] < 0, above)
            self.assertNotIn("F:", asked)

    def test_rejects_other_arguments(self):
        self.assertIn("takes no template", self.ask("", 2, "new forearm --ask")[1])
        self.assertIn("which a bundle cannot record", self.ask("", 2, "new --ask --bundle b.zip")[1])

    def test_settings_overrule_answers(self):
        text, _ = self.ask(answers(), 0, "new --ask --set body.min_wall_mm=1.5")
        self.assertIn("min_wall_mm = 1.5", text)
        self.builds(text)

    def test_document_has_file_and_diameter(self):
        done = self.fusee("new --ask --json", input=answers().encode())
        document = harness.json.loads(done.stdout)
        self.assertEqual((done.returncode, document["ok"]), (0, True))
        self.assertIn("length_mm = 45\n", document["text"])
        self.assertLessEqual(document["pulley_diameter_mm"], 30)

    def test_random_answers_build(self):
        """Or they are refused because the load would pull the joint past its dead centre, with a room that builds."""
        generator = random.Random(43)
        refused = 0
        for _ in range(6):
            low, high = -generator.choice((0, 15, 30, 90, 180)), generator.choice((20, 45, 90, 180))
            typed = answers(length=str(generator.choice((12, 30, 80, 250, 1000))), span=f"{low}..{high}",
                            room=str(generator.choice((34, 50, 90))), load=f"{generator.choice((1, 10, 30))} N",
                            motor=generator.choice(("n20-d3", "nema17-d5", "XL330", "4 mm")), tendon=generator.choice(("0.3", "0.56", "1 mm")))
            with self.subTest(typed=typed):
                done = self.fusee("new --ask", input=typed.encode())
                text, asked = done.stdout.decode(), done.stderr.decode()
                if done.returncode == 4:
                    refused += 1
                    self.assertRegex(asked, "the load pulls the joint past its dead centre at alpha = ")
                    lines = typed.splitlines()
                    lines[3] = re.search(r"try ([\d.]+) mm in place of .* for question 4", asked)[1]
                    text, _ = self.ask("\n".join(lines) + "\n")
                else:
                    self.assertEqual(done.returncode, 0, asked)
                self.builds(text)
        self.assertEqual(refused, 1)  # 1 m, 10 N, a tendon of 0.3 mm, 34 mm of room

    def test_signal_ends_question(self):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([harness.PROGRAM, "new", "--ask"], stdin=theirs, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   cwd=self.folder, env=harness.ENVIRONMENT)
        self.assertTrue(select.select([process.stderr], [], [], 20)[0])
        begun = time.monotonic()
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=20)
        os.close(ours)
        os.close(theirs)
        self.assertEqual((process.returncode, out), (130, b""))
        self.assertLess(time.monotonic() - begun, 10)


class Templates(harness.Scratch):
    def test_list_has_whole_sentences_in_groups(self):
        lines = self.expect("new", 0).stdout.decode().splitlines()
        for template in self.expect_json("new", 0)["templates"]:
            line = next(line for line in lines if line.startswith(f"  {template['name']} "))
            self.assertTrue(line.endswith("."), line)
            self.assertLessEqual(len(line), 80)
            group = [line for line in lines[:lines.index(line)] if line and not line.startswith(" ")][-1]
            self.assertEqual(group, template["group"])


class Refusals(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "forearm.toml").write_bytes(self.fusee("new forearm").stdout)

    def test_wide_range_names_a_drum_that_builds(self):
        for verb in ("build forearm.toml --dry-run", "analyze forearm.toml"):
            words = [*verb.split(), "--set", "joint.range_deg=[-60, 60]"]
            layout = self.expect_json(words, 4)["advice_layout"]
            self.assertEqual(layout["template"], "finger_mcp")
            self.assertIn("put a drum on the joint", self.fusee(words).stderr.decode())
            settings = [word for one in layout["settings"] for word in ("--set", f"{one['key']}={one['value']}")]
            self.expect_json(["build", "forearm.toml", "--dry-run", "--set", "joint.range_deg=[-60, 60]", *settings], 0)

    def test_drum_of_the_advice_is_stiff(self):
        for r1 in (5.6, 15):
            (self.folder / "finger.toml").write_bytes(self.fusee("new finger").stdout)
            words = ["build", "finger.toml", "--dry-run", "--set", "joint.range_deg=[-15, 60]", "--set", f"pulley.r1_mm={r1}"]
            layout = self.expect_json(words, 4)["advice_layout"]
            settings = [word for one in layout["settings"] for word in ("--set", f"{one['key']}={one['value']}")]
            load = self.expect_json([*words, *settings], 0)["under_load"]
            self.assertLess(load["max_theta_error_deg"], 1.0)

    def test_other_obstacles_name_no_drum(self):
        self.assertNotIn("advice_layout", self.expect_json("build forearm.toml --dry-run --set pulley.r1_mm=25", 4))

    def test_typed_number_comes_first(self):
        for key, typed in (("guides.EB_mm", 5), ("guides.ED_mm", 5), ("joint.length_mm", 10)):
            advice = self.expect_json(f"build forearm.toml --dry-run --set {key}={typed}", 4)["advice"]
            self.assertEqual(advice[0]["key"], key)
            self.expect_json(f"build forearm.toml --dry-run --set {key}={advice[0]['to']}", 0)


if __name__ == "__main__":
    harness.main()
