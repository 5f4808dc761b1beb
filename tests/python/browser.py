"""A headless Chromium, driven by selenium; tests that want one are skipped where there is none."""
import importlib.util
import shutil
import unittest

there = importlib.util.find_spec("selenium") and shutil.which("chromedriver") and shutil.which("chromium")
needed = unittest.skipUnless(there, "no browser: install chromium, chromium-driver and python3-selenium")


def start():
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    # No sandbox: it wants namespaces that a container may not have. The pages are our own.
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def look(driver, width, height, scheme="light"):
    """A screen of this size (CSS pixels) that prefers the colour scheme; below 600 a phone's."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})


def complaints(driver):
    return [entry["message"] for entry in driver.get_log("browser")]


def wait(driver, condition, seconds=60):
    """What `condition(driver)` gives once it is true; false if it does not become so in time. Elements that the page replaces meanwhile are asked for again."""
    from selenium.common.exceptions import StaleElementReferenceException, TimeoutException
    from selenium.webdriver.support.ui import WebDriverWait
    try:
        return WebDriverWait(driver, seconds, ignored_exceptions=(StaleElementReferenceException,)).until(condition)
    except TimeoutException:
        return False
