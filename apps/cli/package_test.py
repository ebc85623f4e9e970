"""The Debian packages: what they hold runs from wherever it lies, and they depend on what it is linked with.

    package_test.py CPACK BUILD
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CPACK, BUILD = sys.argv[1], Path(sys.argv[2])
ROOT = Path(__file__).resolve().parents[2]


def run(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{words[0]} gave {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="partwise-packages-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.work = Path(cls.folder.name)
        has_learning = (BUILD / "bin" / "partwise-learning").exists()
        parts = ["program", "shared"] + (["learning"] if has_learning else [])
        run(CPACK, "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.work, "-D", f"CPACK_COMPONENTS_ALL={';'.join(parts)}",
            cwd=BUILD)
        cls.packages = {run("dpkg-deb", "-f", path, "Package").strip(): path for path in sorted(cls.work.glob("*.deb"))}
        for path in cls.packages.values():
            run("dpkg-deb", "-x", path, cls.work / "root")

    def depends(self, package):
        return run("dpkg-deb", "-f", self.packages[package], "Depends")

    def test_dependencies_are_those_of_what_is_linked(self):
        self.assertIn("libembree3", self.depends("partwise"))
        self.assertNotIn("torch", self.depends("partwise"))
        if "partwise-learning" in self.packages:
            self.assertRegex(self.depends("partwise-learning"), r"partwise \(= \d+\.\d+\.\d+\).*libtorch")

    def test_the_program_runs_with_the_files_beside_it(self):
        usr = self.work / "root" / "usr"
        shared = {path.relative_to(ROOT) for name in ("data/models", "data/lights", "models") for path in (ROOT / name).rglob("*") if path.is_file()}
        self.assertGreater(len(shared), 100)
        for name in sorted(shared):
            self.assertTrue((usr / "share" / "partwise" / name).exists(), name)
        for name in ("LICENSE", "NOTICE"):
            self.assertTrue((usr / "share" / "doc" / "partwise" / name).exists(), name)
        elsewhere = self.work / "elsewhere"
        elsewhere.mkdir()
        program = usr / "bin" / "partwise"
        run(program, "decompose", usr / "share/partwise/data/models/chair.off", "--tolerance", "0.1", "--hulls", "hulls.obj", cwd=elsewhere)
        self.assertIn("o ", (elsewhere / "hulls.obj").read_text())
        if "partwise-learning" in self.packages:
            self.assertIn("--material", run(program, "edit", "--help"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
