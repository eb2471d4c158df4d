#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""The documentation site in Chromium, at a desk (1280 x 900) and on a phone (390 x 844): browser_test.py FOLDER
with what tools/site/build.sh has made. Exit status 77: Selenium, Chromium or the site is missing."""

import sys
import tempfile
import unittest
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    print("skipped: python3-selenium is not installed (tools/setup.sh web)")
    sys.exit(77)

HTML = Path(sys.argv[1]).resolve() / "html"
DESK, PHONE = (1280, 900), (390, 844)
LEAST_TEXT_PX = 9  # of CSS; a phone has two to three points for each


class Site(unittest.TestCase):
    def open(self, page, size):
        options = webdriver.ChromeOptions()
        profile = tempfile.TemporaryDirectory()
        self.addCleanup(profile.cleanup)
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--hide-scrollbars", f"--window-size={size[0]},{size[1]}",
                         f"--user-data-dir={profile.name}", "--host-resolver-rules=MAP * ~NOTFOUND",
                         "--disable-background-networking"):
            options.add_argument(argument)
        if size == PHONE:
            options.add_experimental_option("mobileEmulation", {
                "deviceMetrics": {"width": size[0], "height": size[1], "pixelRatio": 3, "touch": True}})
        driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.addCleanup(driver.quit)
        driver.get(f"file://{HTML}/{page}.html")
        return driver

    def test_copy_takes_the_block(self):
        driver = self.open("docs/boards", DESK)
        driver.execute_script("navigator.clipboard.writeText = async (text) => { window.copied = text; };")
        shown = driver.execute_script("""
            const block = [...document.querySelectorAll("div.highlight")].find(
                (one) => one.textContent.includes("mcu_size.py"));
            block.querySelector("button.copy").click();
            return window.copied;""")
        self.assertEqual(shown, "python3 tests/driver/ports/mcu_size.py stm32 cortex-m4\n")
        blocks, buttons = driver.execute_script(
            "return [document.querySelectorAll('div.highlight').length, document.querySelectorAll('button.copy').length]")
        self.assertEqual(blocks, buttons)
        self.assertGreater(blocks, 3)

    def test_copy_of_a_terminal_takes_its_commands(self):
        driver = self.open("index", DESK)
        driver.execute_script("navigator.clipboard.writeText = async (text) => { window.copied = text; };")
        shown = driver.execute_script("""
            const block = [...document.querySelectorAll("div.highlight")].find(
                (one) => one.textContent.startsWith("$ "));
            block.querySelector("button.copy").click();
            return window.copied;""")
        self.assertEqual(shown, "build/bin/mb4sim run examples/resolute-26.toml --frames 5\n")

    def test_without_a_clipboard_copy_works_too(self):
        driver = self.open("docs/boards", DESK)
        text = driver.execute_async_script("""
            const done = arguments[0];
            Object.defineProperty(navigator, "clipboard", {value: undefined});
            document.execCommand = () => { window.copied = getSelection().toString(); return true; };
            const button = document.querySelector("button.copy");
            button.click();
            setTimeout(() => done(button.textContent), 100);""")
        self.assertEqual(text, "Copied")

    def test_pages_fit(self):
        for size in (DESK, PHONE):
            driver = self.open("index", size)
            for page in ("index", "docs/README", "docs/plot", "docs/boards", "docs/sigrok", "files"):
                driver.get(f"file://{HTML}/{page}.html")
                width = driver.execute_script("return document.documentElement.scrollWidth")
                self.assertLessEqual(width, size[0], (page, size))

    def test_pictures_can_be_read_on_a_phone_and_opened_alone(self):
        driver = self.open("docs/plot", PHONE)
        pictures = driver.execute_script("""
            return [...document.querySelectorAll("article img")].map((one) => {
              let room = one;
              while (room !== null && getComputedStyle(room).overflowX !== "auto") room = room.parentElement;
              return {shown: one.getBoundingClientRect().width / one.naturalWidth, alone: one.closest("a")?.href,
                      scrolls: room !== null && room.scrollWidth > room.clientWidth,
                      wide: one.naturalWidth > innerWidth, source: one.src};
            });""")
        self.assertGreater(len(pictures), 5)
        for picture in pictures:
            # The smallest text of a picture has 9 px.
            self.assertGreaterEqual(9 * picture["shown"], LEAST_TEXT_PX * 0.98, picture)
            self.assertEqual(picture["scrolls"], picture["wide"], picture)
            self.assertEqual(picture["alone"], picture["source"])

    def test_the_button_hides_no_code_on_a_phone(self):
        driver = self.open("docs/plot", PHONE)
        below = driver.execute_script("""
            const block = document.querySelector("div.highlight");
            return block.querySelector("button.copy").getBoundingClientRect().top >=
                   block.querySelector("pre").getBoundingClientRect().bottom;""")
        self.assertTrue(below)

    def test_search_finds_pages_and_no_sources(self):
        driver = self.open("index", DESK)
        driver.get(f"file://{HTML}/search.html?q=driver")
        driver.implicitly_wait(20)
        driver.find_element("css selector", "#search-results li a")
        links = driver.execute_script(
            "return [...document.querySelectorAll('#search-results li a')].map((one) => one.getAttribute('href'))")
        self.assertTrue(links)
        self.assertFalse([link for link in links if link.startswith("files")], links)


if __name__ == "__main__":
    if not (HTML / "index.html").exists() or not Path("/usr/bin/chromedriver").exists():
        print("skipped: the site or Chromium is missing (tools/setup.sh site, tools/setup.sh web)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
