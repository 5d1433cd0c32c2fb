"""The systemd unit: systemd accepts it, and finds it as little exposed as deploy/README.md says."""

import re
import unittest

import support
from support import TOP, run

TEMPLATE = TOP / "deploy/package/semblante.service.in"


class Unit(unittest.TestCase):
    def setUp(self):
        support.need("systemd-analyze")
        folder = support.temporary_folder()
        self.folder = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.unit = self.folder / "semblante.service"
        text = TEMPLATE.read_text()
        for name, value in {"program": support.PROGRAM, "config": "/etc/semblante/semblante.toml", "CMAKE_INSTALL_PREFIX": "/usr"}.items():
            text = text.replace(f"@{name}@", str(value))
        self.assertNotIn("@{", text)
        self.unit.write_text(text)

    def test_systemd_knows_every_line(self):
        result = run("systemd-analyze", "verify", "--man=no", self.unit)
        # Units of the system itself may have faults; ours has none.
        self.assertEqual([line for line in result.stderr.splitlines() if "semblante.service" in line], [])

    def test_a_line_that_systemd_does_not_know_is_noticed(self):
        self.unit.write_text(self.unit.read_text().replace("NoNewPrivileges=yes", "NoNewPrivilege=yes"))
        self.assertIn("semblante.service", run("systemd-analyze", "verify", "--man=no", self.unit).stderr)

    def test_exposure_is_what_the_readme_says(self):
        result = run("systemd-analyze", "security", "--offline=true", "--no-pager", self.unit)
        if "Overall exposure level" not in result.stdout:
            self.skipTest("this systemd has no offline analysis: " + result.stderr.strip())
        found = re.search(r"Overall exposure level for semblante.service: ([0-9.]+)", result.stdout).group(1)
        told = re.search(r"exposure level ([0-9.]+) of 10", (TOP / "deploy/README.md").read_text()).group(1)
        self.assertLessEqual(float(found), float(told), result.stdout)


support.main()
