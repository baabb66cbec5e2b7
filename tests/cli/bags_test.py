"""fusee calibrate, compare and simulate with recordings of ROS 2, written by bags.py."""

import math
import shutil
import subprocess

import bags
import harness

RATIO = 'schema = 1\nname = "joint"\n[transmission]\nkind = "ratio"\nratio = 4.0\n'
START, STEP = 1_750_000_000 * 10**9, 20_000_000  # ns
METADATA = "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n{files}  message_count: 2\n"


def rows(seed=1, strokes=8, steps=60, lash=math.radians(4)):
    """Motor and joint, rad: a joint with play of `lash` at the motor, and a little repeatable noise."""
    pulley, state = -0.7, seed
    for i in range(strokes * steps + 1):
        share = i % (2 * steps) / steps
        alpha = -0.7 + 1.4 * (share if share <= 1 else 2 - share)
        pulley = min(max(pulley, alpha - lash / 2), alpha + lash / 2)
        state = (1103515245 * state + 12345) % 2**31  # the generator of ANSI C
        yield alpha, pulley / 4 + 0.0003 * (state / 2**31 - 0.5)


def csv(seed=1):
    return "time_s,alpha_rad,theta_rad\n" + "".join(f"{i / 50!r},{alpha!r},{theta!r}\n" for i, (alpha, theta) in enumerate(rows(seed)))


def plotjuggler(seed=1):
    lines = [f"{START // 10**9 + i / 50:.6f},{theta!r},{alpha!r}\n" for i, (alpha, theta) in enumerate(rows(seed))]
    return "__time,/joint/states/hinge/position,/motor/states/hinge/position\n" + "".join(lines)


def two_topics(seed=1, big=False):
    for i, (alpha, theta) in enumerate(rows(seed)):
        stamp = START + i * STEP
        for topic, angle in (("/motor/states", alpha), ("/joint/states", theta)):
            yield topic, bags.JOINT_STATE, stamp + 3_000_000, bags.joint_state(stamp, ["hinge"], [angle], big=big)


def one_topic(seed=1):
    for i, (alpha, theta) in enumerate(rows(seed)):
        stamp = START + i * STEP
        yield "/joint_states", bags.JOINT_STATE, stamp + 3_000_000, bags.joint_state(stamp, ["joint", "motor"], [theta, alpha])


class Bags(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "joint.toml").write_text(RATIO)

    def put(self, name, seed=1, **options):
        (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / name).write_bytes(bags.mcap(two_topics(seed), **options))

    def test_same_run_gives_same_bytes(self):
        """Runs have equal names, which the outputs repeat: the content of a file decides its format."""

        def folder_of(base, seed, write):
            bag = base / f"run_{seed}"
            bag.mkdir()
            write(bag, seed)

        def split_mcap(bag, seed):
            messages = list(two_topics(seed))
            for part in range(11):
                (bag / f"x_{part}.mcap").write_bytes(bags.mcap(messages[part * 90 : (part + 1) * 90], chunk=40))
            (bag / "metadata.yaml").write_text(METADATA.format(files="".join(f"    - x_{part}.mcap\n" for part in range(11))))

        file = {
            "csv": lambda path, seed: path.write_text(csv(seed)),
            "plotjuggler": lambda path, seed: path.write_text(plotjuggler(seed)),
            "mcap": lambda path, seed: path.write_bytes(bags.mcap(two_topics(seed), chunk=50)),
            "zstd": lambda path, seed: path.write_bytes(bags.mcap(one_topic(seed), chunk=50, pack=("zstd", bags.zstd))),
            "packed_file": lambda path, seed: path.write_bytes(bags.zstd(bags.mcap(one_topic(seed)))),
            "big_endian": lambda path, seed: path.write_bytes(bags.mcap(two_topics(seed, big=True))),
            "db3": lambda path, seed: bags.db3(path, two_topics(seed)),
            "packed_messages": lambda path, seed: bags.db3(path, one_topic(seed), pack=bags.zstd, page=1024),
            "folder_of_db3": lambda path, seed: folder_of(path.parent, seed, lambda bag, s: bags.db3(bag / "x_0.db3", two_topics(s))),
            "folder_of_parts": lambda path, seed: folder_of(path.parent, seed, split_mcap),
        }
        reference = None
        for kind, write in file.items():
            (self.folder / kind).mkdir()
            for seed in (1, 2):
                write(self.folder / kind / f"run_{seed}", seed)
            done = self.expect(f"calibrate joint.toml {kind}/run_1 {kind}/run_2 -o out_{kind} --no-audit", 0)
            if kind not in ("csv", "plotjuggler"):
                self.assertIn(b"time is that of the message headers", done.stderr)
                self.assertIn(b"in rad", done.stderr)
            files = {name: harness.Content(content) for name, content in self.files(f"out_{kind}").items()}
            reference = reference or files
            self.assertEqual(set(files), set(reference))
            for name, content in files.items():
                self.assertEqual(content, reference[name], f"{kind}: {name}")
        self.assertIn(b"backlash", reference["calibration.json"])

    def test_reading_leaves_nothing_beside_the_recording(self):
        open_base = bags.db3(self.folder / "run.db3", two_topics(), wal=True)
        copied = self.folder / "copied"
        copied.mkdir()
        for name in ("run.db3", "run.db3-wal"):
            shutil.copy(self.folder / name, copied)
        open_base.close()
        before = {path.name: path.read_bytes() for path in copied.iterdir()}
        self.assertLess(len(before["run.db3"]), 10_000)  # all messages are in the write-ahead log
        self.expect("simulate arm.toml copied/run.db3 -o simulated.csv", 0)
        self.assertEqual(len((self.folder / "simulated.csv").read_text().splitlines()), 482)  # a header, the first row, and 8 strokes of 60 steps
        self.assertEqual({path.name: path.read_bytes() for path in copied.iterdir()}, before)
        copied.chmod(0o555)
        self.expect("simulate arm.toml copied/run.db3 -o again.csv", 0)
        copied.chmod(0o755)

    def test_unfinished_recordings_are_read(self):
        whole = bags.mcap(two_topics(), chunk=50)
        (self.folder / "run.mcap").write_bytes(whole[: len(whole) * 2 // 3])
        self.expect("calibrate joint.toml run.mcap --no-audit", 0, err="the recording is unfinished: .* whole messages before its end are read")
        bags.db3(self.folder / "run.db3", two_topics())
        whole = (self.folder / "run.db3").read_bytes()
        (self.folder / "run.db3").write_bytes(whole[: len(whole) * 2 // 3])
        self.expect("simulate arm.toml run.db3 -o simulated.csv", 0, err="the recording is unfinished: its file is cut off")
        self.assertGreater(len((self.folder / "simulated.csv").read_text().splitlines()), 200)

    def test_folder_with_missing_parts_is_read(self):
        self.put("bag/x_0.mcap")
        self.expect("simulate arm.toml bag/ -o a.csv", 0, err="bag: note: alpha is /motor/states/hinge/position in rad")
        (self.folder / "bag/metadata.yaml").write_text(METADATA.format(files="    - bag/x_0.mcap\n    - x_1.mcap\n"))
        self.expect("simulate arm.toml bag -o b.csv", 0, err="metadata.yaml lists x_1.mcap, which is missing")
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())
        (self.folder / "empty").mkdir()
        self.expect("simulate arm.toml empty -o c.csv", 3, err="is a directory")

    def test_options_choose_topics(self):
        messages = [
            (topic, kind, i * STEP, data)
            for i, (alpha, theta) in enumerate(rows())
            for topic, kind, data in (
                ("/states", bags.JOINT_STATE, bags.joint_state(0, ["m1", "m2", "m3"], [alpha, theta, 0.0], [1.5, 0.0, 0.0])),
                ("/ft", "geometry_msgs/msg/WrenchStamped", bags.wrench(0, 2.5)),
                ("/weight", "std_msgs/msg/Float64", bags.float64(0.25)),
            )
        ]
        (self.folder / "run.mcap").write_bytes(bags.mcap(messages))
        self.expect("calibrate joint.toml run.mcap", 3, err="not obvious which joint is alpha.*/states/m1/position, /states/m2/position, /states/m3/position")
        chosen = "--column alpha=m1 --column theta=/states/m2/position"
        # 1.5 Nm about O are 15 N at C, 100 mm away.
        for column, unit, shown in (("/ft/wrench/force/y", "", "2.5"), ("/weight/data", "--unit load=kg", "2.45"), ("/states/m1/effort", "", "15.0")):
            done = self.fusee(f"simulate arm.toml run.mcap {chosen} --column load={column} {unit}")
            self.assertEqual(done.returncode, 0, done.stderr)
            header, first = done.stdout.decode().splitlines()[:2]
            self.assertTrue(dict(zip(header.split(","), first.split(",")))["load_N"].startswith(shown), first)
        self.expect(f"calibrate joint.toml run.mcap {chosen} --column load=/nothing", 3, err="no topic or joint.*/weight/data")

    def test_bundle_replays_bags(self):
        self.put("bag/x_0.mcap", chunk=50)
        (self.folder / "bag/metadata.yaml").write_text(METADATA.format(files="    - x_0.mcap\n"))
        bags.db3(self.folder / "run.db3", two_topics(2))
        self.expect("calibrate joint.toml bag run.db3 --no-audit --bundle bug.zip", 0)
        shutil.rmtree(self.folder / "bag")
        self.expect("replay bug.zip", 0)

    def test_compressed_nothing_cannot_fill_the_memory(self):
        block = ((128 * 1024) << 3 | 2).to_bytes(3, "little") + b"\0"
        bomb = b"\x28\xb5\x2f\xfd\x00\x58" + block * 100_000 + b"\1\0\0"  # 13 GB of zeros in 400 kB
        (self.folder / "bomb.mcap").write_bytes(bags.mcap(two_topics(), chunk=10, pack=("zstd", lambda raw: bomb)))
        (self.folder / "bomb").write_bytes(bomb)
        for name in ("bomb.mcap", "bomb"):
            limited = ["bash", "-c", f"ulimit -v 3000000; timeout 60 {harness.PROGRAM} calibrate joint.toml {name}"]
            done = subprocess.run(limited, cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True, timeout=90)
            self.assertEqual(done.returncode, 3, done.stderr)


if __name__ == "__main__":
    harness.main()
