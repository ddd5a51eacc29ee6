"""The program under test, the studies, its answers, and what tests of it share."""
import base64
import csv
import json
import os
import pty
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")
WASHER, DRIVE, GRINDER = (os.path.join(STUDIES, "examples", name + ".toml")
                          for name in ("washing-machine", "optical-drive", "angle-grinder"))
# The row in thicker oil: all starts balance, and the search takes a third of the row's. For what asks for no other motion.
EASY = (ROW, "--set", "balancer.drag=0.25")
# A study of a machine, as text.
MACHINE = """[rotor]
mass = "12 kg"
stiffness = "48 kN/m"
damping = "400 N s/m"
eccentricity = "0.2 mm"
[balancer]
balls = 2
race_radius = "30 mm"
mass = "60 g"
drag = "2e-4 N m s"
[speed]
profile = "constant"
speed = "2000 rpm"
"""
SVG = "{http://www.w3.org/2000/svg}"
SNAPSHOTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "snapshots")

# Lines of progress soon, so that no test waits for them; a test of the usual ten seconds takes this away.
os.environ["EQUIPOISE_PROGRESS"] = "0.3"


# Cases of seconds run by themselves (ctest's entries that end in .slow), and all others together.
SLOW = "--slow" in sys.argv


def slow(case):
    case.slow = True
    return case


def main():
    """Runs the slow cases of the script, or all others."""
    def cases(suite):
        for one in suite:
            yield from cases(one) if isinstance(one, unittest.TestSuite) else [one]

    every = cases(unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"]))
    asked = [one for one in every if hasattr(getattr(one, one.id().rpartition(".")[2]), "slow") == SLOW]
    done = unittest.TextTestRunner(verbosity=0).run(unittest.TestSuite(asked))
    sys.exit(0 if asked and done.wasSuccessful() else 1)


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=600, check=False, **options)


def answer(*arguments, quiet=True):
    done = run(*arguments, "--json", *(["--quiet"] if quiet else []))
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"{arguments}: exit {done.returncode}, {done.stderr}")
    return json.loads(done.stdout)


def on_a_terminal(*arguments, **environment):
    """Exit code and all bytes that a terminal gets."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.execve(PROGRAM, [PROGRAM, *arguments], {**os.environ, **environment})
    seen = b""
    while True:
        try:
            part = os.read(terminal, 65536)
        except OSError:
            break
        if not part:
            break
        seen += part
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), seen


def started(*arguments):
    return subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def ended_cpu():
    """CPU seconds of all processes that have ended: other programs hardly stretch what one takes of them."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return ended.ru_utime + ended.ru_stime


def interrupted(process):
    """Standard output and error of a process after SIGINT, and its exit code. It does not go on computing."""
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        user, system = file.read().rpartition(")")[2].split()[11:13]
    before = ended_cpu() + (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=120)
    after = ended_cpu() - before
    if after > 6.0:  # it takes a second or two
        raise AssertionError(f"{after:.1f} CPU seconds after SIGINT")
    return *said, process.returncode


def content(path):
    with open(path, "rb") as file:
        return file.read()


def text_of(path):
    return content(path).decode()


def picture_of(path):
    """The words of a picture file that --plot wrote, which is well-formed, and nothing but shapes in concrete colours."""
    found = list(xml.etree.ElementTree.parse(path).iter())
    for one in found:
        assert one.tag.removeprefix(SVG) in {"svg", "title", "g", "line", "path", "rect", "circle", "text", "image"}, one.tag
        for name, value in one.attrib.items():
            assert "var(" not in value and not name.startswith("on"), (name, value)
            assert name != "href" or value.startswith("data:image/png;base64,"), value
    return "\n".join(one.text or "" for one in found if one.tag in (SVG + "text", SVG + "title"))


def squares_of(path):
    """The colours of the squares in a picture file, as rows from the top: its PNG, read by other code than wrote it."""
    found = [one for one in xml.etree.ElementTree.parse(path).iter(SVG + "image")]
    data = base64.b64decode(found[0].attrib["href"].partition(",")[2])
    chunks, at = {}, 8
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        chunks[data[at + 4:at + 8]] = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(data[at + 4:at + 8 + size])
        at += 12 + size
    width, height, depth = struct.unpack(">IIB", chunks[b"IHDR"][:9])
    rows, palette = zlib.decompress(chunks[b"IDAT"]), chunks[b"PLTE"]
    length = 1 + (width * depth + 7) // 8
    for k in range(height):
        row = rows[k * length + 1:(k + 1) * length]
        if depth == 4:
            row = [part for byte in row for part in (byte >> 4, byte & 15)][:width]
        yield [palette[3 * square:3 * square + 3].hex() for square in row]


def rows_of(path):
    """Of a table, without its comments."""
    return list(csv.DictReader(line for line in text_of(path).splitlines() if not line.startswith("#")))


def with_xarray(script, *arguments):
    """What a script that uses xarray prints as JSON."""
    python = next((p for p in (sys.executable, "/usr/bin/python3") if os.path.exists(p) and subprocess.run(
        [p, "-c", "import xarray"], capture_output=True, check=False).returncode == 0), None)
    if not python:
        raise unittest.SkipTest("needs python3-xarray")
    done = subprocess.run([python, "-c", script, *arguments], capture_output=True, text=True, check=False, timeout=120)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def refused(self, *arguments, words=(), **options):
        """In one line, before any work."""
        done = run(*arguments, **options)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), (arguments, done.stderr))
        for word in words:
            self.assertIn(word, done.stderr)
