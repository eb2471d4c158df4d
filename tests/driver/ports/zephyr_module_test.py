#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The Zephyr module as far as it can be checked without Zephyr.

  zephyr_module_test.py ROOT files [CXX]   what module.yml names exists; mistakes do not compile
  zephyr_module_test.py ROOT tools         devicetree and Kconfig, by Zephyr's own Python packages of
                                           PyPI: devicetree and kconfiglib. Exit status 77 without them
"""

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
GOOD = {"HAS_clock_frequency": 1, "clock_frequency": 20000000, "ma_frequency": 5000000, "protocol": 0,
        "data_bits": 30, "no_flags": 0, "single_turn_bits": 26, "crc_polynomial": 67, "crc_start": 0,
        "gray_code": 0, "spi_max_frequency": 5000000}
IMPOSSIBLE = "the chip cannot do what the devicetree asks for"
WRONG = [({"data_bits": 65}, IMPOSSIBLE), ({"data_bits": 256 + 30}, IMPOSSIBLE),
         ({"ma_frequency": 10}, IMPOSSIBLE), ({"clock_frequency": 26000000}, IMPOSSIBLE),
         ({"crc_start": 0x10000}, IMPOSSIBLE), ({"crc_polynomial": 0x1FFFF0}, IMPOSSIBLE),
         ({"single_turn_bits": 33}, "single-turn-bits is 1 to 32"),
         ({"single_turn_bits": 0}, "single-turn-bits is 1 to 32")]

# As much of Zephyr's own bindings and Kconfig as the module refers to.
BASE_BINDINGS = {
    "base.yaml": "properties:\n  compatible: {type: string-array, required: true}\n"
                 "  reg: {type: array}\n  status: {type: string}\n  label: {type: string}\n",
    "sensor-device.yaml": "include: base.yaml\nproperties:\n  friendly-name: {type: string}\n",
    "spi-device.yaml": "include: base.yaml\non-bus: spi\nproperties:\n  reg: {required: true}\n"
                       "  spi-max-frequency: {type: int, required: true}\n",
    "spi.yaml": "description: a bus\ncompatible: test,spi\ninclude: base.yaml\nbus: spi\n",
}
BOARD = """/dts-v1/;
/ { arduino_spi: spi { compatible = "test,spi"; #address-cells = <1>; #size-cells = <0>; }; };
"""
BASE_KCONFIG = """
config CPP
	bool "C++"
choice STD_CPP
	prompt "standard"
config STD_CPP11
	bool "11"
config STD_CPP17
	bool "17"
endchoice
config REQUIRES_FULL_LIBCPP
	bool "library"
config SENSOR
	bool "sensors"
config SPI
	bool "SPI"
config DT_HAS_OPENMB4_IC_MB4_ENABLED
	def_bool y
source "{module}"
"""


def check_files(root, compiler):
    import yaml
    module = root / "drivers/zephyr/module.yml"
    found = yaml.safe_load(module.read_text(encoding="utf-8"))
    base = root / "drivers"  # Zephyr looks for zephyr/module.yml in the root of a module
    build = found["build"]
    assert set(found) == {"name", "build", "samples"}, found
    assert (base / build["cmake"] / "CMakeLists.txt").is_file()
    assert (base / build["kconfig"]).is_file()
    bindings = base / build["settings"]["dts_root"] / "dts/bindings"
    assert (bindings / "sensor/openmb4,ic-mb4.yaml").is_file()
    for folder in found["samples"]:
        assert list((base / folder).glob("*/sample.yaml")), folder
    binding = yaml.safe_load((bindings / "sensor/openmb4,ic-mb4.yaml").read_text(encoding="utf-8"))
    wanted = {name.replace("-", "_") for name in binding["properties"]} | {"spi_max_frequency"}
    assert wanted == {name for name in GOOD if not name.startswith("HAS")}, wanted

    def compile_with(changes):
        flags = [f"-DDT_0_{name}={value}" for name, value in {**GOOD, **changes}.items()]
        places = [root / "tests/driver/ports", root / "drivers/zephyr/include",
                  root / "drivers/include", root / "regmap/generated/mb4"]
        return subprocess.run([compiler, "-std=c++17", "-fsyntax-only", *flags,
                               *(f"-I{place}" for place in places),
                               root / "drivers/zephyr/openmb4_sensor.cpp"],
                              capture_output=True, text=True, check=False)

    good = compile_with({})
    assert good.returncode == 0, good.stderr
    for changes, message in WRONG:
        result = compile_with(changes)
        assert result.returncode != 0 and message in result.stderr, f"{changes}: {result.stderr}"
    print(f"module.yml names what exists; {len(WRONG)} mistakes of a devicetree do not compile")


def check_devicetree(root, folder):
    from devicetree import dtlib, edtlib
    for name, text in BASE_BINDINGS.items():
        (folder / name).write_text(text)
    bindings = [str(root / "drivers/zephyr/dts/bindings"), str(folder)]
    overlay = (root / "drivers/zephyr/samples/position/app.overlay").read_text(encoding="utf-8")

    def read(text):
        path = folder / "board.dts"
        path.write_text(BOARD + text)
        return edtlib.EDT(str(path), bindings).label2node["encoder"]

    properties = {name: each.val for name, each in read(overlay).props.items()}
    expected = {"spi-max-frequency": 5000000, "ma-frequency": 2500000, "data-bits": 28,
                "single-turn-bits": 26, "protocol": "biss-c", "crc-polynomial": 0x43, "crc-start": 0,
                "no-flags": False, "gray-code": False}
    assert properties.items() >= expected.items(), properties
    assert "clock-frequency" not in properties
    for old, new in (("data-bits = <28>;", ""), ("data-bits", "data-bit"),
                     ("ma-frequency", 'protocol = "biss-b"; ma-frequency'),
                     ("<26>", '"26"')):
        try:
            read(overlay.replace(old, new))
        except (dtlib.DTError, edtlib.EDTError):
            continue
        raise AssertionError(f"a devicetree with '{new}' in place of '{old}' is accepted")


def check_kconfig(root, folder):
    import kconfiglib
    (folder / "Kconfig").write_text(
        BASE_KCONFIG.replace("{module}", str(root / "drivers/zephyr/Kconfig")))
    config = kconfiglib.Kconfig(str(folder / "Kconfig"), warn_to_stderr=False)
    config.warn_assign_undef = True
    config.load_config(str(root / "drivers/zephyr/samples/position/prj.conf"))
    assert not config.warnings, config.warnings
    values = {name: config.syms[name].str_value for name in ("OPENMB4", "OPENMB4_SENSOR", "SPI")}
    assert set(values.values()) == {"y"}, values
    config.syms["CPP"].set_value("n")
    assert config.syms["OPENMB4_SENSOR"].str_value == "n"


def check_tools(root):
    missing = [name for name in ("devicetree", "kconfiglib") if importlib.util.find_spec(name) is None]
    if missing:
        print(f"skipped: {sys.executable} has no {', '.join(missing)} (packages of PyPI, see docs/driver.md)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        check_devicetree(root, Path(folder))
        check_kconfig(root, Path(folder))
    print("binding, overlay, Kconfig and prj.conf are read by Zephyr's own packages")
    return 0


if __name__ == "__main__":
    ROOT = Path(sys.argv[1]).resolve()
    if sys.argv[2] == "files":
        check_files(ROOT, sys.argv[3])
    else:
        sys.exit(check_tools(ROOT))
