# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The installed tree as others use it: from an empty folder, without this repository.

Usage: package_test.py BUILD CMAKE CC
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from programs import call, version

BUILD, CMAKE, CC = sys.argv[1:4]
CHIP = "revision 0x20, version 0x84\n"  # tables 41 and 42
FIRMWARE = "".join(f"position {1000 + k}\n" for k in range(5))  # the ramp of ramp.toml

MINOR = ".".join(version().split(".")[:2])
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(foreign LANGUAGES C CXX)
find_package(openmb4 @MINOR@ REQUIRED)
add_executable(transfer transfer.c)
target_link_libraries(transfer PRIVATE mb4::mb4sim)
add_executable(position position.cpp)
target_link_libraries(position PRIVATE mb4::driver mb4::mb4sim)
if(NOT EXISTS ${openmb4_RTL_DIR}/mb4/mb4.f)
  message(FATAL_ERROR "no RTL in ${openmb4_RTL_DIR}")
endif()
""".replace("@MINOR@", MINOR)

# A program in C needs no C++ compiler.
C_PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(foreign LANGUAGES C)
find_package(openmb4 @MINOR@ REQUIRED)
add_executable(positions positions.c)
target_link_libraries(positions PRIVATE mb4::c mb4::mb4sim)
""".replace("@MINOR@", MINOR)
# What the scenario of examples/simulator/positions.c sends: ramps from 1000 by 3 and from 500.
POSITIONS = "".join(f"SSI {1000 + 3 * i}, BiSS C {500 + i}\n" for i in range(3))

# The driver on the simulator, joined by the C interface.
POSITION = r"""
#include <mb4sim.h>

#include <cstdio>
#include <mb4/device.hpp>
#include <mb4/mb4.hpp>

struct Bus {
  mb4sim* sim;
  bool transfer(mb4::Span<const std::uint8_t> tx, mb4::Span<std::uint8_t> rx) {
    return mb4sim_spi_transfer(sim, tx.data(), rx.empty() ? nullptr : rx.data(), tx.size()) == 0;
  }
};
struct Clock {
  mb4sim* sim;
  std::uint32_t now_us() {
    mb4sim_advance_ns(sim, 100);
    return static_cast<std::uint32_t>(mb4sim_time_ns(sim) / 1000);
  }
};

int main() {
  char error[200];
  mb4sim* sim = mb4sim_open(
      "[[channel]]\nnumber = 1\n[[channel.slave]]\nprotocol = \"biss-c\"\n"
      "preset = \"resolute-26\"\ndata = 0x2ABCDEF\n", error, sizeof error);
  if (sim == nullptr) return std::puts(error), 1;
  Bus bus{sim};
  Clock clock{sim};
  mb4::Device<Bus, Clock> device(bus, clock);
  mb4::Config config;
  config.ma_hz = 10'000'000;
  config.channels[0].protocol = mb4::Protocol::kBissC;
  config.slaves[0].enabled = true;
  config.slaves[0].data_bits = 28;
  config.slaves[0].flags = mb4::Flags::kErrorWarning;
  config.slaves[0].crc_polynomial = 0x43;
  if (!device.configure(config)) return 1;
  const auto reading = device.read_frame();
  if (!reading) return 1;
  std::printf("position %llu\n", static_cast<unsigned long long>(reading->position));
  mb4sim_close(sim);
  return 0;
}
"""


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        first = os.path.join(cls.folder.name, "first")
        call(CMAKE, "--install", BUILD, "--prefix", first)
        # The tree can be moved.
        cls.prefix = os.path.join(cls.folder.name, "moved")
        os.rename(first, cls.prefix)
        cls.lib = next(os.path.dirname(os.path.join(path, name))
                       for path, _, names in os.walk(cls.prefix) for name in names
                       if name == "libmb4sim.so")

    def path(self, *names):
        return os.path.join(self.prefix, *names)

    def work(self, name):
        folder = os.path.join(self.folder.name, name)
        os.mkdir(folder)
        return folder

    def test_everything_is_there_and_nothing_points_elsewhere(self):
        for name in ("bin/mb4sim", "include/mb4sim.h", "include/openmb4/mb4/device.hpp",
                     "include/openmb4/mb4_regs.hpp", "share/openmb4/rtl/mb4/mb4.f",
                     "share/openmb4/rtl/mb4/mb4_core.sv",
                     "share/openmb4/rtl/common/enc_check.svh",
                     "share/openmb4/regmap/generated/mb4/mb4_regs_pkg.sv", "share/man/man1/mb4sim.1",
                     "share/openmb4/examples/resolute-26.toml",
                     "share/bash-completion/completions/mb4sim",
                     "share/zsh/site-functions/_mb4sim"):
            self.assertTrue(os.path.isfile(self.path(name)), name)
        # Every file that the lists name.
        for room in ("common", "biss", "mb4"):
            folder = self.path("share/openmb4/rtl", room)
            with open(os.path.join(folder, room + ".f"), encoding="utf-8") as file:
                for line in file:
                    name = line.strip().removeprefix("-F ")
                    if name and not name.startswith("//"):
                        self.assertTrue(os.path.isfile(os.path.join(folder, name)), line)
        for path, _, names in os.walk(self.prefix):
            for name in names:
                if name.endswith((".cmake", ".pc")):
                    with open(os.path.join(path, name), encoding="utf-8") as file:
                        text = file.read()
                    self.assertNotIn(BUILD, text, name)
                    self.assertNotIn(os.path.join(self.folder.name, "first"), text, name)

    def test_documents_are_there_and_their_links_lead_somewhere(self):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        documents = self.path("share/doc/openmb4")
        pages = ["docs/" + name for name in os.listdir(os.path.join(root, "docs"))
                 if name.endswith(".md")]
        self.assertGreater(len(pages), 10)
        for name in ["README.md", "CHANGELOG.md", "LICENSE", *pages]:
            self.assertTrue(os.path.isfile(os.path.join(documents, name)), name)
        links = 0
        for folder, _, names in os.walk(documents):
            for name in names:
                if not name.endswith(".md"):
                    continue
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    for link in re.findall(r"\]\(([^)#:]+\.(?:md|svg))", file.read()):
                        self.assertTrue(os.path.isfile(os.path.join(folder, link)),
                                        f"{name}: {link}")
                        links += 1
        self.assertGreater(links, 30)

    def test_command_runs_from_there(self):
        command = self.path("bin/mb4sim")
        example = self.path("share/openmb4/examples/resolute-26.toml")
        self.assertIn("frames good 2, bad 0", call(command, "run", example, "--frames", "2"))
        with open(self.path("share/man/man1/mb4sim.1"), encoding="utf-8") as page:
            self.assertEqual(page.read(), call(command, "man"))
        with open(self.path("share/bash-completion/completions/mb4sim"), encoding="utf-8") as file:
            self.assertEqual(file.read(), call(command, "completion", "bash"))

    def test_find_package_from_an_empty_folder(self):
        folder = self.work("cmake")
        with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write(PROJECT)
        with open(os.path.join(folder, "position.cpp"), "w", encoding="utf-8") as file:
            file.write(POSITION)
        shutil.copy(self.path("share/openmb4/examples/c/transfer.c"), folder)
        build = os.path.join(folder, "build")
        call(CMAKE, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        call(CMAKE, "--build", build)
        self.assertEqual(call(os.path.join(build, "transfer")), CHIP)
        # 0x2ABCDEF without its two flags.
        self.assertEqual(call(os.path.join(build, "position")), f"position {0x2ABCDEF >> 2}\n")

    def test_find_package_from_c(self):
        folder = self.work("cmake_c")
        with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write(C_PROJECT)
        shutil.copy(self.path("share/openmb4/examples/simulator/positions.c"), folder)
        build = os.path.join(folder, "build")
        call(CMAKE, "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
             env=dict(os.environ, CXX="/no/such/compiler"))
        call(CMAKE, "--build", build)
        self.assertEqual(call(os.path.join(build, "positions")), POSITIONS)

    def test_other_minor_version_is_refused(self):
        folder = self.work("version")
        with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write("cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES NONE)\n"
                       "find_package(openmb4 9.9 REQUIRED)\n")
        with self.assertRaises(AssertionError) as caught:
            call(CMAKE, "-S", folder, "-B", os.path.join(folder, "b"),
                 f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertRegex(str(caught.exception), r"not accepted:\s+\S*openmb4Config.cmake, version: 0")

    def pkg_config(self):
        """The environment in which pkg-config and the loader find the tree."""
        if shutil.which("pkg-config") is None:
            self.skipTest("pkg-config is not installed")
        return dict(os.environ, PKG_CONFIG_PATH=os.path.join(self.lib, "pkgconfig"),
                    LD_LIBRARY_PATH=self.lib)

    def test_pkg_config_knows_every_part(self):
        environment = self.pkg_config()
        version = call(self.path("bin/mb4sim"), "--version").split()[1]
        for name, header in (("mb4sim", "mb4sim.h"), ("mb4_c", "mb4.h"),
                             ("mb4driver", "mb4/device.hpp")):
            with self.subTest(name=name):
                self.assertEqual(call("pkg-config", "--modversion", name, env=environment).strip(),
                                 version)
                folder = call("pkg-config", "--cflags", name, env=environment).strip()
                self.assertTrue(os.path.isfile(os.path.join(folder.removeprefix("-I"), header)))

    def test_examples_build_as_their_headers_say(self):
        environment = self.pkg_config()
        expected = {"transfer.c": CHIP, "positions.c": POSITIONS, "firmware.c": FIRMWARE}
        found = [os.path.join(path, name)
                 for path, _, names in os.walk(self.path("share/openmb4/examples"))
                 for name in names if name.endswith((".c", ".cpp"))]
        self.assertLessEqual(set(expected), {os.path.basename(example) for example in found})
        for example in found:
            name = os.path.basename(example)
            with self.subTest(example=name), open(example, encoding="utf-8") as file:
                # In C99 without a warning.
                flags = call("pkg-config", "--cflags", "mb4sim", "mb4_c", env=environment).split()
                call(CC, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only",
                     example, *flags)
                commands = re.findall(r"^ \* {3}(cc .*)$", file.read(), re.MULTILINE)
                if name.startswith("board_"):  # a part of firmware.c
                    continue
                self.assertEqual(len(commands), 1, "the header names one command")
                folder = self.work(name)
                shutil.copytree(os.path.dirname(example), folder, dirs_exist_ok=True)
                # cc is this build's compiler, and says nothing.
                os.symlink(shutil.which(CC), os.path.join(folder, "cc"))
                done = subprocess.run(
                    commands[0], shell=True, cwd=folder, capture_output=True, text=True,
                    timeout=200, check=False,
                    env=dict(environment, PATH=folder + os.pathsep + environment["PATH"]))
                self.assertEqual((done.returncode, done.stdout, done.stderr),
                                 (0, expected[name], ""), commands[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
