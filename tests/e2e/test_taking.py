"""What is seen of a motion is taken away: pictures, a table, a film."""

from __future__ import annotations

import base64
import csv
import io
import struct
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from playwright.sync_api import Page, expect
from tests.e2e.lecture import Lecture
from tests.e2e.test_figure import numbers_in
from tests.e2e.test_plots import open_plots
from tests.e2e.waiting import PATIENCE

pytestmark = pytest.mark.e2e

SVG = "{http://www.w3.org/2000/svg}"


def take(page: Page, form: str, folder: Path) -> Path:
    """The file that the dialog of sharing offers by a name with `form` in it."""
    with page.expect_download(timeout=PATIENCE) as download:
        page.get_by_role("dialog").get_by_role("button", name=f"({form})").click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    return path


def open_dialog(lecture: Lecture, query: str) -> Page:
    page = open_plots(lecture, query)
    page.locator(".plot-menu summary").click()
    page.locator(".plot-menu").get_by_role("button", name="Share").click()
    page.get_by_role("dialog").wait_for()
    return page


def test_pictures_show_what_is_seen(lecture: Lecture, tmp_path: Path) -> None:
    """Vectors with letters of their own, which need nothing from anywhere; the same in pixels, twice as fine."""
    page = open_dialog(lecture, "?scene=double-pendulum&lang=en&at=2&plot=-potential")
    read = numbers_in(page.locator(".readouts .q-1 .number").text_content())
    file = take(page, "SVG", tmp_path)
    text = file.read_text(encoding="utf-8")
    root = ET.fromstring(text)
    letters = [element.text or "" for element in root.iter(f"{SVG}text")]
    assert {"φ", "1", "2", "ℓ", "m", "g", "in rad"} <= {letter.strip() for letter in letters}
    assert [number for letter in letters for number in numbers_in(letter) if number == read[0]]
    strokes = {path.get("stroke") for path in root.iter(f"{SVG}path")}
    colour, _ = colours = page.evaluate(
        """['q-1', 'energy-potential'].map((className) => {
          const probe = document.body.appendChild(Object.assign(document.createElement("i"), {className}));
          const { color } = getComputedStyle(probe);
          probe.remove();
          return color;
        })"""
    )
    drawn = ["#{:02x}{:02x}{:02x}".format(*map(int, numbers_in(each)[:3])) in strokes for each in colours]
    assert drawn == [True, False]
    assert "data:font/woff2;base64," in text
    assert "http" not in text.replace("http://www.w3.org/", "")
    boxes = page.locator(".drawing").bounding_box(), page.locator(".plots").bounding_box()
    assert boxes[0] is not None
    assert boxes[1] is not None
    width = max(box["x"] + box["width"] for box in boxes if box) - min(box["x"] for box in boxes if box)
    assert float(root.get("width", "0")) == pytest.approx(width, abs=1)
    pixels = take(page, "PNG", tmp_path).read_bytes()
    assert pixels.startswith(b"\x89PNG\r\n")
    assert struct.unpack(">II", pixels[16:24])[0] == pytest.approx(2 * width, abs=2)
    shown = page.evaluate(
        """async (data) => {
          const image = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))]));
          const ink = new OffscreenCanvas(image.width, image.height).getContext("2d");
          ink.drawImage(image, 0, 0);
          const all = ink.getImageData(0, 0, image.width, image.height).data;
          const found = {};
          for (let i = 0; i < all.length; i += 4) {
            const colour = `rgb(${all[i]}, ${all[i + 1]}, ${all[i + 2]})`;
            found[colour] = (found[colour] ?? 0) + 1;
          }
          return found;
        }""",
        base64.b64encode(pixels).decode(),
    )
    assert shown.get(colour, 0) > 500  # a curve and an angle


def test_a_table_has_the_curves_that_are_shown(lecture: Lecture, tmp_path: Path) -> None:
    page = open_dialog(lecture, "?scene=elastic-pendulum&lang=en&at=2&plot=-kinetic,2:4")
    read = numbers_in(page.locator(".readouts .q-0 .number").text_content())[0]
    file = take(page, "CSV", tmp_path)
    rows = list(csv.reader(io.StringIO(file.read_text(encoding="utf-8"))))
    assert rows[0] == ["t in s", "y in m", "phi in rad", "potential in J", "balance in J"]
    times = [float(row[0]) for row in rows[1:]]
    assert times[0] == 2
    assert times[-1] == 4
    assert times == sorted(times)
    assert float(rows[1][1]) == pytest.approx(read, abs=6e-4)
    assert len({round(float(row[4]), 6) for row in rows[1:]}) == 1  # what the energies sum up to stays


def test_why_there_is_no_film_is_said_with_what_helps(lecture: Lecture) -> None:
    lecture.page.add_init_script(
        "window.MediaRecorder = undefined; HTMLCanvasElement.prototype.toBlob = (done) => done(null)"
    )
    page = open_dialog(lecture, "?scene=pendulum&lang=en&at=1")
    for form, told in (
        ("WebM", "This browser records no films. Current"),
        ("PNG", "Make the window smaller, or take the SVG."),
    ):
        page.get_by_role("dialog").get_by_role("button", name=f"({form})").click()
        expect(page.get_by_role("alert")).to_contain_text(told)


@pytest.mark.smooth
def test_a_film_plays_what_was_seen(lecture: Lecture, tmp_path: Path) -> None:
    """As long as the part of the motion that the plots show; then the moment is where it was. Stopped, it is kept.

    Looked at on an empty page, since those of the service play no files.
    """
    page = open_dialog(lecture, "?scene=pendulum&lang=en&at=1&plot=2:3.5")
    file = take(page, "WebM", tmp_path)
    assert file.suffix == ".webm"
    told, length, width, height, different = page.context.new_page().evaluate(
        """async (data) => {
          const blob = new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], {type: "video/webm"});
          const film = Object.assign(document.createElement("video"), {muted: true, src: URL.createObjectURL(blob)});
          await new Promise((resolve) => (film.onloadeddata = resolve));
          const told = film.duration;
          // A busy browser has not drawn yet what it has found; until then its picture is empty, or the one before.
          const seen = (at) => {
            const drawn = new Promise((resolve) => film.requestVideoFrameCallback(resolve));
            film.currentTime = at;
            return drawn;
          };
          const ink = new OffscreenCanvas(film.videoWidth, film.videoHeight).getContext("2d");
          const frame = () => {
            ink.drawImage(film, 0, 0);
            return ink.getImageData(0, 0, film.videoWidth, film.videoHeight).data;
          };
          await seen(0.001);
          const first = frame();
          await seen(told);
          const last = frame();
          let different = 0;
          for (let i = 0; i < first.length; i += 4) different += Math.abs(first[i] - last[i]) > 60;
          return [told, film.currentTime, film.videoWidth, film.videoHeight, different];
        }""",
        base64.b64encode(file.read_bytes()).decode(),
    )
    assert told == pytest.approx(length, abs=0.5)  # recorders leave it out
    assert 1.4 < length < 25  # it begins with a still picture, for as long as a busy machine needs to write one
    assert width % 2 == height % 2 == 0
    assert different > 300
    assert "at=1&" in page.url + "&"
    page.get_by_role("dialog").get_by_role("button", name="(WebM)").click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Stop and keep").click()
    assert download.value.suggested_filename == "pendulum.webm"
