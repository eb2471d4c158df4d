# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The page in Chromium, without a network: every control, and its results against the native
simulator (the Python package, which is on the C interface)."""

import csv
import functools
import http.server
import json
import os
import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from xml.etree import ElementTree

import openmb4
import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "wrong_setups"))
import hint_cases  # noqa: E402

PAGE = Path(os.environ["MB4_WEB_PAGE"])
MB4SIM = os.environ["MB4_WEB_MB4SIM"]
RIGHT_SETUPS = 200
HINT_SEED = int(os.environ.get("MB4_HINT_SEED", "1"))
ENOUGH_S = 60  # on a machine that is busy with other tests
LINKS = ["", "#encoder=resolute-36&movement=ramp&cable=100&ma=5000000",
         "#encoder=ic-mu&bits=20&movement=still&cable=0&ma=1000000",
         "#encoder=ic-nq&movement=sine&cable=2&ma=2500000",
         "#encoder=lika-amm36&bits=38&movement=ramp&cable=333.5&ma=10000000"]
# Of each other master.
MASTER_LINKS = {
    "axi": ["", "&encoder=resolute-32&movement=ramp&cable=100&ma=5000000",
            "&encoder=ic-mu&bits=20&movement=still&cable=0&ma=1000000"],
    "clb": ["", "&encoder=resolute-36&movement=ramp&cable=100&ma=5000000",
            "&encoder=ic-mu&bits=64&movement=still&cable=0&ma=1000000"],
    "pru": ["", "&encoder=resolute-36&movement=ramp&cable=100&ma=5000000",
            "&encoder=ic-mu&bits=57&movement=still&cable=0&ma=1000000"]}
# Encoders that it does not read: docs/axi.md, "When to take it" (a word of 32 bits, nE, nW, CRC 0x43), docs/clb.md (two
# flags, a CRC), docs/pru.md (CRC 0x43 or none, two flags). BiSS B and SSI are for the iC-MB4 alone.
NOT_BISS_C = {"ic-nq", "lika-sma1-b", "acuro", "posital-ssi-25", "tr-ce-65"}
NOT_FOR = {"axi": NOT_BISS_C | {"resolute-36", "ic-nqc", "ic-mr-mt", "eds-sensor", "bp3-spw"},
           "clb": NOT_BISS_C | {"bp3-spw"},
           "pru": NOT_BISS_C | {"eds-sensor", "bp3-spw"}}
NAMES = {"ic-mb4": "iC-MB4", "axi": "biss_axi", "clb": "biss_clb", "pru": "biss_pru"}
STATUS = (0xF0, 12)  # the group of registers that is read after each step


class Browser:
    """The page, by the ids of its elements."""

    def __init__(self, driver, address):
        self.driver, self.address = driver, address

    def __getitem__(self, name):
        return self.driver.find_element("id", name)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def text(self, name):
        return self[name].text

    def wait(self, script):
        end = time.monotonic() + ENOUGH_S
        while not (found := self.run(f"return {script}")):
            assert time.monotonic() < end, script
            time.sleep(0.02)
        return found

    def open(self, link=""):
        self.driver.get("about:blank")
        self.driver.get(self.address + link)
        return int(self.wait("document.documentElement.dataset.firstFrameMs"))

    def choose(self, name, value):
        Select(self[name]).select_by_value(value)

    def enter(self, name, text, key=Keys.ENTER):
        self.run("arguments[0].scrollIntoView({block: 'center'}); arguments[0].select()", self[name])
        self[name].send_keys(text, key)

    def click(self, name):
        self.run("arguments[0].scrollIntoView({block: 'center'})", self[name])
        self[name].click()

    def said(self):
        return self.text("said")

    def wrong(self, name):
        """The message by a field; None without one."""
        field = self[name]
        if field.get_attribute("aria-invalid") is None:
            assert self.run("return $(arguments[0] + '-wrong')?.hidden ?? true", name)
            return None
        note = self[field.get_attribute("aria-describedby")]
        assert note.is_displayed()
        return note.text

    def good(self):
        return int(self.text("good"))

    def frames(self):
        """The table of the last frames, the oldest first."""
        return self.run("return [...document.querySelectorAll('#frames tr')].map("
                        "row => [...row.cells].map(cell => cell.textContent)).reverse()")

    def errors(self):
        return [entry for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING")]


@pytest.fixture(scope="session")
def server():
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    handler = functools.partial(Quiet, directory=str(PAGE.parent))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as one:
        threading.Thread(target=one.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{one.server_port}/{PAGE.name}"
        one.shutdown()


@pytest.fixture(scope="session")
def driver(tmp_path_factory):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1200,900", f"--user-data-dir={tmp_path_factory.mktemp('profile')}",
                     # No network but the test's own server.
                     "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
                     "--disable-background-networking"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    one = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    one.set_script_timeout(ENOUGH_S)
    yield one
    one.quit()


@pytest.fixture
def page(driver, server):
    one = Browser(driver, server)
    one.open()
    yield one
    assert one.errors() == []


def native_frame(chip):
    """A frame in the words of the page's table."""
    row = chip.driver.read_all(1)[0]
    frame = row["frame"]
    cells = [f"{int(row['time_ns']) / 1000:.3f}", "1"]
    if row["result"]["code"] or frame["code"][0]:
        return cells
    reading = frame["reading"][0]
    return cells + [int(reading["raw"]), int(reading["position"]), int(not reading["slave_error"]),
                    int(not reading["slave_warning"]), int(reading["crc"]), "ok"]


def as_numbers(cells):
    """A row of the page's table in the form of native_frame()."""
    if cells[2:7] == [""] * 5:
        assert cells[-1] != "" and not cells[-1].startswith("ok"), cells
        return cells[:2]
    # "wrong data" is what the page knows of the word that was sent; the driver has taken it as good.
    return [cells[0], cells[1], int(cells[2], 16), int(cells[3]), int(cells[4]), int(cells[5]),
            int(cells[6], 16), "ok"]


@pytest.mark.parametrize("link", LINKS)
def test_frames_and_spi_answers_equal_the_native_simulator(page, link):
    page.open(link)
    assert page.run("return document.getElementById('problem').textContent") == ""
    faults = [option.get_attribute("value") for option in Select(page["fault-kind"]).options]
    good = 0
    with openmb4.Simulator(page.run("return document.getElementById('scenario').textContent")) as chip:
        chip.driver.configure()
        assert [native_frame(chip)] == [as_numbers(row) for row in page.frames()]

        for _ in range(5):
            page.click("step")
        assert [native_frame(chip) for _ in range(5)] == [as_numbers(row) for row in page.frames()[1:]]

        # Registers are open from here on: after each action the page reads them.
        page.run("document.querySelector('#register-groups details').open = true")
        page.wait("document.getElementById('field-EOT')?.dataset.shown")
        read_status = bytes([0x03, STATUS[0], *[0] * STATUS[1]])
        status = chip.spi(read_status)[2:]

        for kind in faults:
            table = page.run("return faultTable(arguments[0])", kind)
            said = page.run("$('fault-kind').value = arguments[0]; $('fault').click();"
                            "const said = $('said').textContent;"
                            "for (let i = 0; i < 3; ++i) $('step').click();"
                            "return said", kind)
            assert "in the next frame" in said
            chip.inject(table)
            expected = []
            for _ in range(3):
                expected.append(native_frame(chip))
                status = chip.spi(read_status)[2:]
            shown = [as_numbers(row) for row in page.frames()[-3:]]
            assert shown == expected, kind
            good += sum(len(row) > 2 for row in shown)
            for name, address, bit in (("EOT", 0xF0, 0), ("nSCDERR", 0xF0, 4), ("CDMTIMEOUT", 0xF3, 7)):
                value = status[address - STATUS[0]] >> bit & 1
                assert page[f"field-{name}"].get_attribute("value") == str(value), kind
        assert 0 < good < 3 * len(faults)  # faults were seen, and were over

        for text in ("03 EA 00 00", "02 ED 01", "03 C0 " + "00 " * 32, "07 02", "05 00 00 00 00 00"):
            page.run("document.getElementById('spi-log').textContent = ''")
            page.enter("spi-bytes", text)
            answer = chip.spi(bytes.fromhex(text))
            assert page.run("return document.getElementById('spi-log').textContent").splitlines() == [
                "> " + bytes.fromhex(text).hex(" ").upper(), "< " + answer.hex(" ").upper()]
            chip.spi(read_status)
        assert chip.time_ns == page.run("return chip.timeNs")
        assert chip.clk_cycles == page.run("return chip.clocks")


def native_run(text, frames, tmp_path):
    """Rows, simulated time in us and clocks of `mb4sim run`; the rows in the words of the page's
    table."""
    scenario, table = tmp_path / "set-up.toml", tmp_path / "rows.csv"
    scenario.write_text(text, encoding="utf-8")
    run = subprocess.run([MB4SIM, "run", scenario, "--frames", str(frames), "--csv", table, "--json"],
                         capture_output=True, text=True, check=False)
    assert run.returncode in (0, 1), run.stderr  # 1: a frame was bad
    with table.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(lines))[1:]
    summary = json.loads(run.stdout)["summary"]
    return [row[1:] for row in rows], summary["time_us"], summary["clocks"]


@pytest.mark.parametrize("master, link", [(master, link) for master, links in MASTER_LINKS.items() for link in links])
def test_rows_of_another_master_equal_the_native_simulator(page, tmp_path, master, link):
    page.open(f"#master={master}{link}")
    assert page.run("return $('problem').textContent") == ""
    assert page["master"].get_attribute("value") == master
    text = page.run("return $('scenario').textContent")
    assert f'type = "{master}"' in text
    shown = page.frames()
    for _ in range(5):
        page.click("step")
    shown += page.frames()[1:]
    for kind in page.run("return [...$('fault-kind').options].map(one => one.value)"):
        # Its times count from now, and in a scenario from power-on.
        now_ps = page.run("return chip.timePs")
        table = page.run("return faultTable(arguments[0])", kind)
        text += "\n" + re.sub(r"at_us = ([\d.]+)",
                              lambda at, now=now_ps: f"at_us = {float(at[1]) + now / 1e6:.6f}", table)
        page.run("$('fault-kind').value = arguments[0]; $('fault').click();"
                 "for (let i = 0; i < 3; ++i) $('step').click();", kind)
        shown += page.frames()[-3:]
        if kind == "silent":  # it meets one frame
            assert [row[-1] == "ok" for row in shown[-3:]] == [False, True, True]
    rows, us, clocks = native_run(text, len(shown), tmp_path)
    assert shown == rows
    assert page.run("return chip.timePs") / 1e6 == pytest.approx(us, abs=1e-3)
    assert page.run("return chip.clocks") == clocks
    bad = sum(row[-1] != "ok" for row in shown)
    assert [row[-1] for row in shown[:6]] == ["ok"] * 6 and 5 <= bad < len(shown) - 10


def open_groups(page):
    page.run("document.querySelectorAll('#register-groups details').forEach(one => one.open = true)")
    page.wait("[...document.querySelectorAll('#register-groups details')].every("
              "one => one.querySelector('input')?.dataset.shown)")


@pytest.mark.parametrize("master", MASTER_LINKS)
def test_registers_of_another_master_are_those_of_the_native_simulator(page, tmp_path, master):
    page.open(f"#master={master}&movement=still")
    assert page.text("registers-title") == f"Registers of {NAMES[master]}"
    open_groups(page)
    scenario = tmp_path / "set-up.toml"
    scenario.write_text(page.run("return $('scenario').textContent"), encoding="utf-8")
    fields = json.loads(subprocess.run([MB4SIM, "regs", scenario, "--frames", "1", "--all", "--json"],
                                       capture_output=True, text=True, check=True).stdout)["fields"]
    expected = {field["name"].split("[")[0]: field["value"] for field in fields}
    shown = page.run("return Object.fromEntries([...document.querySelectorAll('#register-groups input')].map("
                     "one => [one.id.replace('field-', ''), one.value]))")
    # The time goes on.
    assert len(shown) >= 16 and set(shown) <= set(expected)
    differ = {name for name, value in shown.items() if int(value, 0) != expected[name]}
    assert {name for name in differ if "TIME" not in name} == set()


def test_a_field_of_another_master_is_written_and_gives_its_hint(page):
    page.open("#master=axi&movement=still")
    open_groups(page)
    assert page.text("register-bus") == "AXI4-Lite" and page.text("register-unit") == "Word"
    assert page["field-POSITION_BITS"].get_attribute("value") == "0x1A"
    page.enter("field-POSITION_BITS", "20")
    assert page.said() == "POSITION_BITS is written"
    assert not page["hints"].is_displayed()  # no word has been asked for
    page.click("step")
    assert page.text("state") != "ok"
    assert page.text("hints") == (
        "slave 1 sends 28 bits, the master takes 22 (POSITION_BITS = 20, nE, nW)")
    page.enter("field-POSITION_BITS", "26")
    page.click("step")
    assert page.text("state") == "ok" and not page["hints"].is_displayed()
    # MA: 100 MHz / 2 / MA_DIVIDER.
    page.enter("field-MA_DIVIDER", "50")
    page.click("step")
    assert page.text("state") == "ok"
    rises = page.run("return diagram.picture.edges.filter(one => one.place === 0 && one.level === 1).map(one => one.time)")
    assert {round(b - a) for a, b in zip(rises, rises[1:-1])} == {1000}
    for name, text, words in (("SINGLE_POINT_DATA", "1", "SINGLE_POINT_DATA: can only be read"),
                              ("MA_DIVIDER", "256", "MA_DIVIDER: 256 has more than 8 bits"),
                              ("MA_DIVIDER", "x", "MA_DIVIDER: this is no number")):
        page.run("arguments[0].readOnly = false", page[f"field-{name}"])
        page.enter(f"field-{name}", text)
        assert page.wrong(f"field-{name}") == words
        page[f"field-{name}"].send_keys(Keys.ESCAPE)


def test_whole_words_of_another_master(page):
    page.open("#master=pru")
    assert page["register-name"].get_attribute("value") == "TRIGGER_PERIOD"
    page.click("register-read")
    assert page.said() == "TRIGGER_PERIOD = 0x00004E20"  # 100 us at 200 MHz
    page.enter("register-value", "40000", Keys.TAB)
    page.click("register-write")
    assert page.said() == "TRIGGER_PERIOD is written"
    page.enter("register-name", "0x224", Keys.TAB)
    page.click("register-read")
    assert page.said() == "TRIGGER_PERIOD = 0x00009C40"
    open_groups(page)
    page.enter("field-CTRL_WORD", "0xFEDCBA98")  # all 32 bits
    assert page["field-CTRL_WORD"].get_attribute("value") == "0xFEDCBA98"
    page.enter("register-name", "CTRL", Keys.TAB)
    page.click("register-read")
    assert page.said() == "CTRL = 0xFEDCBA98"
    for _ in range(3):
        page.click("step")
    times = [float(row[0]) for row in page.frames()[-2:]]
    assert times[1] - times[0] == pytest.approx(200, abs=0.1)
    for name, value, field, words in (
            ("NONSENSE", "1", "register-name", "no register 'NONSENSE'"),
            ("0x225", "1", "register-name", "no register '0x225'"),
            ("0x1000", "1", "register-name", "no register '0x1000'"),
            ("LENGTHS", "0x100000000", "register-value", "LENGTHS: this is no word")):
        page.enter("register-name", name, Keys.TAB)
        page.enter("register-value", value, Keys.TAB)
        page.click("register-write")
        assert page.said() == page.wrong(field) == words
    page.choose("master", "ic-mb4")
    assert page.wrong("register-name") is None and page.wrong("register-value") is None


def test_master_is_chosen_and_the_link_keeps_it(page, driver):
    assert [option.text for option in Select(page["master"]).options] == list(NAMES.values())
    assert "master" not in page["link"].get_attribute("value")
    page.open("#encoder=lma10&movement=ramp&cable=3&ma=5000000&pace=0&fault=silent")  # of an older page
    assert page["master"].get_attribute("value") == "ic-mb4" and page["encoder"].get_attribute("value") == "lma10"
    for master, name in reversed(NAMES.items()):
        page.choose("master", master)
        assert not page["problem"].is_displayed() and page.text("state") == "ok" and page.said() == ""
        assert (page["encoder"].get_attribute("value"), page["frequency"].get_attribute("value")) == ("lma10", "5000000")
        spi = master == "ic-mb4"
        assert page["spi-bytes"].is_displayed() == spi and page["no-spi"].is_displayed() != spi
        if spi:
            continue
        assert page.text("no-spi") == f"{name} has no SPI: its host is on AXI4-Lite, which the registers above use."
        link = page["link"].get_attribute("value")
        assert link == driver.current_url and f"master={master}&" in link
        scenario = page.run("return $('scenario').textContent")
        page.open("#" + link.split("#")[1])
        assert page.run("return $('scenario').textContent") == scenario
        assert page.text("state") == "ok"
    page.run("location.hash = '#master=clb&ma=8000000'")  # by hand in the open page
    page.wait("setup.master === 'clb' && setup.ma === 8000000")
    for fragment, words in (("#master=none", "link: master 'none' is not possible"),
                            ("#master=toString", "link: master 'toString' is not possible"),
                            ("#master=pru&ma=2500000", "link: ma '2500000' is not possible"),
                            ("#master=axi&encoder=resolute-36", "link: encoder 'resolute-36' is not possible"),
                            ("#master=axi&encoder=ic-mu&bits=40", "the master takes 3 to 34")):
        page.open(fragment)
        assert words in page.text("problem"), fragment
        assert page.good() == 1 and page["master"].get_attribute("value") == "ic-mb4"  # the usual set-up


def test_a_model_that_the_page_has_not_is_refused(page):
    slave = '[[channel.slave]]\nprotocol = "biss-c"\npreset = "resolute-26"\n'
    one, two = (f"[[channel]]\nnumber = {number}\n{slave}" for number in (1, 2))
    for text, left_out in ((f'[master]\ntype = "axi"\n[chip]\nfeatures = "full"\n{one}', "full"),
                           (f'[master]\ntype = "axi"\n{one}{two}', "biss_axi with more than one channel"),
                           (f'[master]\ntype = "pru"\n[chip]\nf_clk_hz = 80000000\n{one}', "80000000"),
                           (f'[host]\ninterface = "axi"\n{one}', "axi")):
        said = page.run("try { chip.open(arguments[0]); return ''; } catch (error) { return error.message; }", text)
        assert left_out in said and "-DMB4_ONE_MODEL=OFF" in said, (text, said)
    page.click("step")
    assert page.text("state") == "ok"  # the chip before stays


def test_what_a_master_cannot_read_is_told(page):
    page.choose("encoder", "posital-ssi-25")
    page.choose("frequency", "2500000")
    page.choose("master", "pru")
    assert page.said() == ("biss_pru does not make 2.5 MHz from its clock; Posital, SSI, 25 bits, multiple "
                           "transmission: the master reads BiSS C only")
    assert page["encoder"].get_attribute("value") == "resolute-26" and page.text("state") == "ok"
    option = page["encoder"].find_element("css selector", "option[value='posital-ssi-25']")
    assert option.get_attribute("disabled") and option.get_attribute("title") == "the master reads BiSS C only"
    page.choose("master", "ic-mb4")
    assert not option.get_attribute("disabled")
    # A length that a master does not take: the chip before goes on.
    page.choose("encoder", "ic-mu")
    page.enter("bits", "64")
    page.choose("master", "axi")
    assert page.wrong("bits") == ("the master takes 3 to 34, position and flags, not 64; the chip stays as it was")
    assert "[master]" not in page.run("return $('scenario').textContent")
    page.click("step")
    assert page.text("state") == "ok"
    page.enter("bits", "34")
    assert page.wrong("bits") is None and page.text("state") == "ok"
    assert 'type = "axi"' in page.run("return $('scenario').textContent")


@pytest.mark.parametrize("master", MASTER_LINKS)
def test_every_encoder_and_frequency_of_another_master(page, master):
    page.open(f"#master={master}")
    encoders = page.run("return [...$('encoder').options].filter(one => !one.disabled).map(one => one.value)")
    refused = page.run("return [...$('encoder').options].filter(one => one.disabled).map(one => [one.value, one.title])")
    assert all(title for _, title in refused)
    assert {name for name, _ in refused} == NOT_FOR[master]
    frequencies = page.run("return [...$('frequency').options].map(one => one.value)")
    for name, values in (("encoder", encoders), ("frequency", frequencies)):
        for value in values:
            page.run("$(arguments[0]).value = arguments[1];"
                     "$(arguments[0]).dispatchEvent(new Event('change', {bubbles: true}))", name, value)
            assert not page["problem"].is_displayed(), page.text("problem")
            assert page.text("state") == "ok", (name, value)
            # The picture shows the whole frame: its parts end where MA ends.
            parts = page.run("return diagram.picture.brackets.map(part => part.text)")
            assert parts[:3] == ["acknowledge", "start", "CDS"] and "CRC" in parts[-1], (name, value, parts)
            assert page.run("return diagram.picture.edges.some(one => one.place === 0 && one.level === 0 &&"
                            "Math.abs(one.time - diagram.picture.zero) < 1)"), (name, value)
            spans = page.run("return [diagram.picture.brackets.at(-1).to, diagram.picture.seen, diagram.picture.zero]")
            assert spans[2] < spans[0] <= spans[1] + 2e9 / int(page["frequency"].get_attribute("value")), (value, spans)


def hints_of(page, setup):
    """What the page shows when the driver has configured the chip, the host has sent the lines of a
    set-up, and frames were read."""
    return page.run("""
        const [text, lines, frames] = arguments;
        chip.open(text);
        chip.configure();
        for (const line of lines) {
          const words = line.split(" ");
          if (words[0] === "pin") chip.setPin(words[1], Number(words[2]));
          else if (words[0][0] === "+") chip.advance(Number(words[0].slice(1)));
          else chip.spi(words.map((word) => parseInt(word, 16)));
        }
        chip.read(frames);
        showHints();
        return $("hints").hidden ? [] : [...$("hints").children].map(
          (item) => ({...item.dataset, text: item.textContent}));""",
                    setup.scenario, setup.lines, hint_cases.FRAMES)


def test_each_wrong_setup_gives_its_hint(page):
    wrong = [hint_cases.wrong_with(setup, hints_of(page, setup)) for setup in hint_cases.listed()]
    assert len(wrong) >= 80 and [text for text in wrong if text] == []


def test_no_right_setup_gives_a_hint(page, capsys):
    with capsys.disabled():
        print(f"\nright set-ups from seed {HINT_SEED} on (MB4_HINT_SEED)")
    for setup in hint_cases.rights(RIGHT_SETUPS, HINT_SEED):
        assert hints_of(page, setup) == [], setup.scenario


def test_a_hint_comes_with_the_bad_frame_and_goes_with_the_mistake(page):
    assert not page["hints"].is_displayed()
    page.enter("spi-bytes", "02 C0 59")
    assert not page["hints"].is_displayed()  # no word has been asked for
    page.click("step")
    assert page["hints"].is_displayed() and page.text("state") != "ok"
    assert page.text("hints") == "slave 1 sends 28 bits, the chip takes 26 (SCDLEN1 = 0x19)"
    page.enter("spi-bytes", "02 C0 5B")
    page.click("step")
    assert page.text("state") == "ok" and not page["hints"].is_displayed()
    page.run("$('fault-kind').value = 'unplug'; $('fault').click(); $('step').click()")
    assert page.text("state") != "ok" and not page["hints"].is_displayed()  # unplugged, no mistake


def test_clock_rate_as_a_part_of_the_native_one(page, capsys):
    rates = {"browser": [], "native": []}
    with openmb4.Simulator(page.run("return scenario(setup)")) as chip:
        chip.driver.configure()
        page.run("chip.open(scenario(setup)); chip.configure()")
        for _ in range(4):
            rates["browser"].append(page.run(
                "const clocks = chip.clocks, begin = performance.now(); chip.module._web_read_only(1500);"
                "return (chip.clocks - clocks) / (performance.now() - begin) * 1000"))
            clocks, begin = chip.clk_cycles, time.perf_counter()
            chip.driver.read_all(4000)
            rates["native"].append((chip.clk_cycles - clocks) / (time.perf_counter() - begin))
        assert native_frame(chip)[2:] != []
    browser, native = max(rates["browser"]), max(rates["native"])
    with capsys.disabled():
        print(f"\nclocks a second: browser {browser:,.0f}, native {native:,.0f}: "
              f"{browser / native:.2f}")
    assert browser > 0


def test_first_frame_comes_soon_from_a_server_and_from_a_file(driver, server, capsys):
    for address in (server, PAGE.as_uri()):
        one = Browser(driver, address)
        ms = one.open()
        with capsys.disabled():
            print(f"\nfirst frame {ms} ms after opening {address.split(':')[0]}")
        assert one.good() == 1 and one.text("state") == "ok"
        assert one.run("return performance.getEntriesByType('resource').filter("
                       "entry => !entry.name.startsWith('data:')).length") == 0
        assert one.errors() == []


def test_every_encoder_and_frequency(page):
    page.choose("frequency", "1000000")
    assert "ma_hz = 1000000\n" in page.run("return $('scenario').textContent")
    for name in ("encoder", "frequency"):
        for value in page.run("return [...$(arguments[0]).options].map(one => one.value)", name):
            page.run("$(arguments[0]).value = arguments[1];"
                     "$(arguments[0]).dispatchEvent(new Event('change', {bubbles: true}))", name, value)
            assert page["problem"].is_displayed() is False, page.text("problem")
            assert f"{'ma' if name == 'frequency' else name}={value}" in page["link"].get_attribute("value")
            if name == "encoder":
                assert page.text("state") == "ok", value
        page.choose(name, "resolute-26" if name == "encoder" else "10000000")
    page.choose("encoder", "ic-mu")
    page.enter("bits", "30")
    assert "data_bits = 30" in page.run("return document.getElementById('scenario').textContent")
    assert page.text("state") == "ok"


def test_movement_and_cable(page):
    def positions():
        for _ in range(3):
            page.click("step")
        return [int(row[3]) for row in page.frames()[-3:]]

    page.choose("movement", "still")
    assert len(set(positions())) == 1
    page.choose("movement", "ramp")
    first, second, third = positions()
    assert second - first == third - second == 2 ** 26 // 300 + 1
    page.choose("movement", "sine")
    assert len(set(positions())) == 3
    page.enter("cable", "250")
    assert "cable_m = 250" in page.run("return document.getElementById('scenario').textContent")
    before = page["link"].get_attribute("value")
    page.enter("cable", "99999")
    assert page.wrong("cable") == "a number from 0 to 10000; the chip keeps 250"
    assert page["link"].get_attribute("value") == before  # the chip before stays
    page.enter("cable", "10")
    assert page.wrong("cable") is None


def test_a_number_that_cannot_be_used_is_told_by_its_field(page):
    page.choose("encoder", "ic-mu")
    page.enter("bits", "20")
    for name, texts, words in (
            ("cable", ("", "-1", "10001"), "a number from 0 to 10000; the chip keeps 10"),
            ("bits", ("", "2", "65", "20.5"), "a whole number from 3 to 64; the chip keeps 20")):
        good = page[name].get_attribute("value")
        scenario = page.run("return $('scenario').textContent")
        for text in texts:
            page.enter(name, text or Keys.BACKSPACE)
            assert page.wrong(name) == words, text
            assert page.run("return $('scenario').textContent") == scenario
            page.click("step")
            assert page.text("state") == "ok"  # the chip before goes on
        page.enter(name, good)
        assert page.wrong(name) is None
    # A length that is not asked for is no obstacle.
    page.enter("bits", "99")
    page.choose("encoder", "resolute-26")
    assert "resolute-26" in page.run("return $('scenario').textContent")


def test_run_stop_and_pace(page):
    page.click("run")
    assert page.text("run") == "Stop" and not page["step"].is_enabled()
    page.wait("Number(document.getElementById('good').textContent) > 50")
    page.wait("document.getElementById('rate').textContent !== '–'")
    page.click("run")
    count = page.good()
    time.sleep(0.1)
    assert page.good() == count and page.text("run") == "Run"
    assert page.run("return plot.data[0].length") == min(count, 1000)

    page.choose("pace", "1")
    page.click("step")
    page.wait("replay !== null && diagram.until < diagram.picture.to")  # it is being drawn
    page.wait("replay === null")
    assert page.good() == count + 1
    page.click("run")
    page.wait(f"Number(document.getElementById('good').textContent) > {count + 2}")
    page.choose("pace", "8")
    page.click("run")
    assert page.run("return replay") is None


def test_diagram_shows_the_parts_of_a_frame(page):
    parts = page.run("return diagram.picture.brackets.map(part => [part.text, part.to - part.from])")
    assert [text for text, _ in parts] == ["acknowledge", "start", "CDS", "position, 26 bits", "nE nW",
                                           "CRC, 6"]
    assert [round(ns / 100) for _, ns in parts[1:]] == [1, 1, 26, 2, 6]  # periods of 10 MHz
    # SL is SLO half of 106 ns later.
    edges = page.run("return diagram.picture.edges")
    sl, slo = ([edge["time"] for edge in edges if edge["place"] == place] for place in (2, 3))
    assert len(sl) == len(slo) > 10 and all(round(a - b, 3) == 53 for a, b in zip(sl, slo))
    # Something is drawn, in more than one colour.
    assert page.run(
        "const c = document.getElementById('diagram'), seen = new Set();"
        "const d = new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer);"
        "d.forEach(one => seen.add(one)); return seen.size") > 10


def test_registers_by_field(page):
    for details in page.driver.find_elements("css selector", "#register-groups summary"):
        page.run("arguments[0].click()", details)
    page.wait("document.getElementById('field-RDATA64')?.dataset.shown")
    fields = page.run("return [...document.querySelectorAll('.fields input')].map(one => one.id.slice(6))")
    assert sorted(fields) == sorted(page.run("return [...registers.fields.keys()]"))
    # The names and the bits are those of the Python package.
    with openmb4.Simulator(page.run("return scenario(setup)")) as chip:
        chip.driver.configure()
        chip.driver.read_all(1)
        for name in ("FREQS", "SCDLEN1", "SCRCPOLY1", "ENSCD1", "CFGCH1", "SLAVELOC5", "FREQAGS"):
            assert int(page[f"field-{name}"].get_attribute("value"), 0) == chip.regs[name].read(), name
        with pytest.raises(AttributeError):
            chip.regs.NONSENSE

    page.enter("field-FREQS", "4")
    assert page.said() == "FREQS is written"
    assert page["field-FREQS"].get_attribute("value") == "4"
    page.enter("field-SCDATA2", "0x123456789ABCDEF0")
    assert page["field-SCDATA2"].get_attribute("value") == "0x123456789ABCDEF0"
    page.enter("field-FREQS", "32")
    assert page.said() == page.wrong("field-FREQS") == "FREQS: 32 has more than 5 bits"
    page.enter("field-FREQS", "four")
    assert page.said() == page.wrong("field-FREQS") == "FREQS: this is no number"
    assert page["field-FREQS"].get_attribute("value") == "four"  # to be put right
    page.enter("field-FREQS", "4")  # what the chip has
    assert page.wrong("field-FREQS") is None
    page.enter("field-FREQS", "5")
    assert page.said() == "FREQS is written" and page.wrong("field-FREQS") is None
    page.enter("field-FREQS", "four")
    page.enter("field-FREQS", "4")
    page.enter("field-FREQS", "6", Keys.TAB)
    assert page.said() == "FREQS is not written: Enter writes it"
    assert page["field-FREQS"].get_attribute("value") == "4"
    # Codes by their names.
    words = "return document.getElementById('field-CFGCH2').closest('label').querySelector('.meaning').textContent"
    assert page.run(words) == "UNUSED"
    page.enter("field-CFGCH2", "SSI")
    assert (page["field-CFGCH2"].get_attribute("value"), page.run(words)) == ("2", "SSI")
    page.enter("field-CFGCH2", "3")
    for name in ("AGS", "INSTR", "SVALID1", "BREAK"):
        page.enter(f"field-{name}", "1")
        assert "does harm; write the whole register" in page.wrong(f"field-{name}"), name
        page[f"field-{name}"].send_keys(Keys.ESCAPE)
        assert page[f"field-{name}"].get_attribute("value") == "0"
        assert page.wrong(f"field-{name}") is None
    assert not page["field-EOT"].get_attribute("readonly") in (None, "")
    page.enter("field-FREQS", "7", Keys.ESCAPE)
    assert page["field-FREQS"].get_attribute("value") == "4"


def test_whole_registers(page):
    page.enter("register-name", "VERSION", Keys.TAB)
    page.click("register-read")
    assert page.said() == "VERSION = 0x84"
    page.enter("register-name", "FREQAGS", Keys.TAB)
    page.enter("register-value", "0x7C", Keys.TAB)
    page.click("register-write")
    assert page.said() == "FREQAGS is written"
    page.click("register-read")
    assert page.said() == "FREQAGS = 0x7C"
    page.enter("register-name", "0xEB", Keys.TAB)
    page.click("register-read")
    assert page.said() == "VERSION = 0x84"
    for name, value, field, words in (
            ("NONSENSE", "1", "register-name", "no register 'NONSENSE'"),
            ("FREQ", "256", "register-value", "FREQ: this is no byte"),
            ("FREQ", "x", "register-value", "FREQ: this is no byte")):
        page.enter("register-name", name, Keys.TAB)
        page.enter("register-value", value, Keys.TAB)
        page.click("register-write")
        assert page.said() == page.wrong(field) == words
    page.enter("register-value", "1", Keys.TAB)
    page.click("register-read")
    assert page.wrong("register-name") is None and page.wrong("register-value") is None
    # A whole register: INSTR = 100 (table 45). The write takes simulated time.
    page.enter("register-name", "INSTR", Keys.TAB)
    page.enter("register-value", "0x08", Keys.TAB)
    count = page.run("return chip.report().time_ns")
    page.click("register-write")
    assert page.said() == "INSTR is written" and page.run("return chip.report().time_ns") > count


def test_wrong_bytes_are_refused(page):
    clock = page.run("return chip.timeNs")
    for text, wrong in (("03 GG", "GG"), ("123", "123"), ("", "")):
        page.run("document.getElementById('spi-bytes').value = ''")
        page.enter("spi-bytes", text)
        assert page.said() == page.wrong("spi-bytes") == (
            f"SPI: '{wrong}' is no byte; example: 03 EA 00 00")
    assert page.run("return chip.timeNs") == clock
    page.enter("spi-bytes", "03 EA 00")
    assert page.wrong("spi-bytes") is None


def test_links(page, driver):
    page.choose("encoder", "lenz-irs")
    page.enter("cable", "42.5")
    link = page["link"].get_attribute("value")
    assert link == driver.current_url
    text = page.run("return document.getElementById('scenario').textContent")
    page.click("copy")
    page.wait("document.getElementById('said').textContent.includes('the link is')")
    page.open("#" + link.split("#")[1])
    assert page.run("return document.getElementById('scenario').textContent") == text
    assert page["encoder"].get_attribute("value") == "lenz-irs"
    page.run("location.hash = '#encoder=lma10'")  # by hand in the open page
    page.wait("setup.encoder === 'lma10'")
    for fragment, words in (("#what=1", "link: unknown key 'what'"),
                            ("#encoder=none", "link: encoder 'none' is not possible"),
                            ("#ma=3", "link: ma '3' is not possible"),
                            ("#bits=99", "link: bits '99' is not possible"),
                            ("#cable=far", "link: cable 'far' is not possible"),
                            ("#pace=2", "link: pace '2' is not possible"),
                            ("#fault=none", "link: fault 'none' is not possible"),
                            ("#cable=-3", "cable_m")):
        page.open(fragment)
        assert words in page.text("problem"), fragment
        assert page.good() == 1  # the usual set-up runs


def test_a_link_keeps_pace_and_fault(page, driver):
    clock = page.run("return chip.timeNs")
    page.choose("fault-kind", "unplug")
    page.choose("pace", "8")
    assert page.run("return chip.timeNs") == clock  # the same chip
    link = page["link"].get_attribute("value")
    assert link == driver.current_url and link.endswith("&pace=8&fault=unplug")
    page.enter("cable", "20")  # a new set-up leaves both
    page.open("#" + page["link"].get_attribute("value").split("#")[1])
    assert page["cable"].get_attribute("value") == "20"
    assert page["pace"].get_attribute("value") == "8"
    assert page["fault-kind"].get_attribute("value") == "unplug"
    page.choose("pace", "0")
    page.click("fault")
    page.click("step")
    assert page.text("bad") == "1"
    page.open("#encoder=lma10")  # a link without them
    assert page["pace"].get_attribute("value") == "0"
    assert page["fault-kind"].get_attribute("value") == "silent"


def test_a_silent_line_is_thin_with_its_time(page):
    page.run("$('fault-kind').value = 'silent'; $('fault').click(); $('step').click()")
    assert page.text("state") != "ok"
    edges = page.run("return diagram.picture.edges")
    ma, sl = ([edge for edge in edges if edge["place"] == place] for place in (0, 2))
    periods = len(ma) // 2
    assert periods > 1000
    # MA is 10 MHz: each period takes 100 ns, the last one ends with its rising edge.
    ma_us = periods / 10 - 0.05
    low_us = max(b["time"] - a["time"] for a, b in zip(sl, sl[1:])) / 1000
    texts = [text.text for text in svg_of(page).iter("{http://www.w3.org/2000/svg}text")]
    assert f"{periods} periods in {round(ma_us, 2):g} µs" in texts
    assert f"0 for {round(low_us, 2):g} µs" in texts
    assert not any("for" in text for text in texts if text.startswith("1"))
    # Ink in the picture: a column of MA has two rails, one of SL has one line.
    columns = page.run("""
        const {width} = $("diagram");
        const {data} = $("diagram").getContext("2d").getImageData(0, 0, width, 140);
        return [30, 98].map((top) => {
          const counts = [];
          for (let x = width >> 3; x < width >> 2; x += 5) {
            let ink = 0;
            for (let y = top; y < top + 38; ++y) ink += data[4 * (y * width + x) + 3] > 60;
            counts.push(ink);
          }
          return counts.sort((a, b) => a - b)[counts.length >> 1];
        });""")
    assert columns[0] <= 4 and columns[1] <= 2, columns
    page.click("step")
    assert page.text("state") == "ok"
    assert not any(" for " in text.text or " periods " in text.text
                   for text in svg_of(page).iter("{http://www.w3.org/2000/svg}text"))


def svg_of(page):
    return ElementTree.fromstring(page.run("return diagram.svg()"))


def test_dial_shows_the_part_of_all_positions(page):
    page.choose("movement", "still")  # at a third of 2 ** 26
    assert page.text("dial-text") == "33.33 % of 2^26"
    assert page["hand"].get_attribute("transform") == "rotate(120.000)"
    page.choose("movement", "sine")
    page.click("step")
    position = int(page.frames()[-1][3])
    assert page.text("dial-text") == f"{position / 2 ** 26 * 100:.2f} % of 2^26"
    page.run("$('fault').click(); $('step').click()")
    assert page.text("dial-text") == "no position" and page["dial"].get_attribute("class") == "old"
    # All 64 bits are positions of a number that JavaScript cannot hold.
    page.open("#encoder=ic-mu&bits=64&movement=still")
    assert page.text("dial-text").startswith("33.33 % of 2^")


def test_frame_as_files(page, driver, tmp_path):
    driver.execute_cdp_cmd("Browser.setDownloadBehavior",
                           {"behavior": "allow", "downloadPath": str(tmp_path)})

    def saved(button, name):
        page.click(button)
        end = time.monotonic() + ENOUGH_S
        while not (tmp_path / name).exists() or (tmp_path / name).stat().st_size == 0:
            assert time.monotonic() < end, name
            time.sleep(0.02)
        return (tmp_path / name).read_text(encoding="utf-8")

    page.enter("cable", "12.3")  # 65.19 ns each way
    for _ in range(3):
        page.click("step")
    raw, position = page.frames()[-1][2:4]
    texts = [text.text for text in ElementTree.fromstring(saved("save-svg", "frame.svg")).iter(
        "{http://www.w3.org/2000/svg}text")]
    assert texts[:3] == ["MA", "SL", "SLO"] and f"raw word {raw}" in texts

    # Every edge of the read, at its time in simulated ps.
    text = saved("save-vcd", "frame.vcd")
    body = text.split("$dumpvars")[1].split("$end")[1]
    now, edges = None, []
    for line in body.split():
        if line[0] == "#":
            now = int(line[1:])
        else:
            edges.append([now, {"!": 0, "#": 2, "$": 3}[line[1]], int(line[0])])
    assert edges == [[round(edge["time"] * 1000), edge["place"], edge["level"]]
                     for edge in page.run("return diagram.picture.edges") if edge["place"] in (0, 2, 3)]
    # A simulated encoder that plays the file sends the same word.
    with openmb4.Simulator(f"""
[chip]
f_clk_hz = 20000000
[host]
sclk_hz = 10000000
ma_hz = 10000000
[[channel]]
number = 1
[[channel.slave]]
protocol = "replay"
capture = "{tmp_path / 'frame.vcd'}"
ma = "MA"
sl = "SL"
data_bits = 28
flag_bits = 2
crc = 0x43
""") as chip:
        chip.driver.configure()
        reading = chip.driver.read_all(1)[0]["frame"]["reading"][0]
        assert int(reading["position"]) == int(position)


@pytest.mark.parametrize("link", [f"#master={master}{more}" for master in NAMES for more in ("", "&encoder=ic-mu")])
def test_frame_and_positions_are_on_the_first_screen(page, link):
    page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    try:
        page.open(link)
        for name in ("master", "encoder", "link", "run", "step", "fault", "position", "diagram", "plot", "dial"):
            box = page.run("const {top, bottom, right} = $(arguments[0]).getBoundingClientRect();"
                           "return [top, bottom, right]", name)
            assert 0 <= box[0] < box[1] <= 900 and box[2] <= 1280, name
    finally:
        page.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_documents(page):
    page.click("documents")
    assert page["help"].is_displayed()
    text = page.text("help")
    for words in ("encoder (the presets of mb4sim presets)", "SPI by hand", "Limits"):
        assert words in text
    assert "](" not in text and "`" not in text and "|" not in text
    assert not page["all-documents"].is_displayed()  # only on the site of the documents
    count = page.good()
    page.driver.switch_to.active_element.send_keys("s")
    assert page.good() == count
    page.driver.switch_to.active_element.send_keys(Keys.ESCAPE)
    assert not page["help"].is_displayed()


def test_keyboard(page):
    body = page.driver.find_element("tag name", "body")
    count = page.good()
    body.send_keys("s")
    assert page.good() == count + 1
    body.send_keys("f")
    assert "in the next frame" in page.said()
    body.send_keys("s")
    assert page.text("bad") == "1"
    body.send_keys("r")
    page.wait(f"Number(document.getElementById('good').textContent) > {count + 5}")
    body.send_keys("r")
    assert page.text("run") == "Run"
    # A master is chosen with the arrow keys.
    page["master"].send_keys(Keys.DOWN)
    page.wait("setup.master === 'axi'")
    page["master"].send_keys(Keys.UP)
    page.wait("setup.master === 'ic-mb4'")
    # Every control can be reached with Tab.
    page.run("document.activeElement.blur(); scrollTo(0, 0)")
    reached = set()
    for _ in range(60):
        page.driver.switch_to.active_element.send_keys(Keys.TAB)
        reached.add(page.run("return document.activeElement.id || document.activeElement.tagName"))
    assert reached >= {"master", "encoder", "movement", "cable", "frequency", "copy", "run", "step", "pace",
                       "fault", "fault-kind", "SUMMARY", "register-name", "register-write",
                       "register-read", "spi-bytes", "documents", "save-svg", "save-vcd"}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width, master", [(360, "ic-mb4"), (768, "ic-mb4"), (1200, "ic-mb4"),
                                           (360, "axi"), (390, "clb"), (360, "pru"), (1200, "pru")])
def test_nothing_is_cut(page, width, master, scheme):
    page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 500})
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": scheme}]})
    try:
        page.open(f"#master={master}")
        open_groups(page)
        field = {"ic-mb4": "FREQS", "axi": "MA_DIVIDER", "clb": "MA_MATCH1", "pru": "FREQUENCY"}[master]
        page.enter("cable", "99999", Keys.TAB)
        if master == "ic-mb4":
            page.enter("spi-bytes", "GG")
        page.enter("register-name", "NONSENSE")
        page.enter(f"field-{field}", "four")
        assert len(page.driver.find_elements("css selector", ".wrong:not([hidden])")) == 3 + (master == "ic-mb4")
        page.run("$('fault').click(); $('step').click()")  # the state of a bad frame is long
        assert page.text("state") != "ok"
        assert page.run("const {right} = document.querySelector('.figures').getBoundingClientRect();"
                        "return [...document.querySelectorAll('.figures dd')].every("
                        "one => one.getBoundingClientRect().right <= right)")
        assert page.run("return document.documentElement.scrollWidth") <= width
        outside = page.run(
            "return [...document.querySelectorAll('button, input, select, canvas')].filter(one =>"
            "one.offsetParent && (one.getBoundingClientRect().right > innerWidth ||"
            "one.getBoundingClientRect().left < 0)).map(one => one.id)")
        assert outside == []
        ground = page.run("return getComputedStyle(document.body).backgroundColor")
        assert (sum(map(int, ground[4:-1].split(","))) < 200) == (scheme == "dark")
    finally:
        page.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
