"""The report page as a reader's browser sees it."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from urllib.parse import unquote

import numpy as np
import pytest
from PIL import Image

pytestmark = pytest.mark.browser


class Outline(HTMLParser):
    """Collects links, pictures, identities and the text of the page."""

    def __init__(self, text: str):
        super().__init__()
        self.links, self.pictures, self.identities, self.words, self.hidden = [], [], [], [], False
        self.feed(text)
        self.text = " ".join(" ".join(self.words).split())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        if tag == "img":
            self.pictures.append(found)
        if "id" in found:
            self.identities.append(found["id"])
        self.hidden = tag in ("style", "script")

    def handle_endtag(self, tag):
        self.hidden = False

    def handle_data(self, data):
        if not self.hidden:
            self.words.append(data)


@pytest.fixture(scope="module")
def outline(page, browse) -> Outline:
    return Outline(browse(page.as_uri(), "--dump-dom"))


def test_every_link_leads_somewhere(page, outline):
    assert len(outline.links) > 30
    for link in outline.links:
        if link.startswith("#"):
            assert link[1:] in outline.identities, link
        else:
            assert not re.match(r"[a-z]+:", link), f"{link} needs a network"
            assert (page.parent / unquote(link)).is_file(), link


def test_identities_are_unique(outline):
    assert len(outline.identities) == len(set(outline.identities))


def test_every_picture_is_in_the_page_itself_and_has_words(outline):
    assert len(outline.pictures) > 20
    for picture in outline.pictures:
        assert picture["src"].startswith("data:image/png;base64,") and picture["alt"]


def test_every_picture_is_decoded_by_the_browser(page, browse, tmp_path):
    """A copy of the page with a script that counts what the browser could not decode."""
    probe = ("<script>addEventListener('load', () => { const all = [...document.images];"
             "document.body.dataset.pictures = all.length;"
             "document.body.dataset.broken = all.filter(i => !i.complete || i.naturalWidth < 50).length; });</script></body>")
    copy = tmp_path / "probe.html"
    copy.write_text(page.read_text().replace("</body>", probe))
    text = browse(copy.as_uri(), "--virtual-time-budget=20000", "--dump-dom")
    pictures, broken = (int(re.search(rf'data-{name}="(\d+)"', text).group(1)) for name in ("pictures", "broken"))
    assert pictures > 20 and broken == 0


def test_the_page_is_drawn_with_its_colours(page, browse, tmp_path):
    shot = tmp_path / "page.png"
    browse(page.as_uri(), "--window-size=1360,3000", f"--screenshot={shot}")
    pixels = np.asarray(Image.open(shot).convert("RGB")).astype(int)
    assert pixels.shape[:2] == (3000, 1360)
    assert (np.abs(pixels[20] - [0x17, 0x21, 0x2B]).max(axis=1) < 4).mean() > 0.9  # the dark head of the page
    for colour in ((0xDC, 0xF3, 0xE6), (0xFB, 0xE3, 0xE1), (0xFD, 0xF0, 0xD0)):  # pass, fail, missing
        assert (np.abs(pixels - colour).max(axis=2) < 3).sum() > 200, f"no verdict in colour {colour}"


def test_no_text_runs_out_of_a_narrow_window(page, browse, tmp_path):
    probe = ("<script>addEventListener('load', () => { document.body.dataset.wide = document.documentElement.scrollWidth; });"
             "</script></body>")
    copy = tmp_path / "narrow.html"
    copy.write_text(page.read_text().replace("</body>", probe))
    text = browse(copy.as_uri(), "--window-size=800,900", "--virtual-time-budget=20000", "--dump-dom")
    assert int(re.search(r'data-wide="(\d+)"', text).group(1)) <= 800


def test_a_row_for_each_comparison(results, outline):
    for path in results.glob("*/*/coarse/result.json"):
        if "slm_track_200w" in str(path):
            continue
        for measure in json.loads(path.read_text())["measures"]:
            from reports.formatting import quantity_name

            assert quantity_name(measure["name"]) in outline.text


def test_missing_stopped_and_damaged_results_are_named(outline):
    assert "marangoni_layer in OpenFOAM: not run yet" in outline.text
    assert "slm_track_200w in OpenFOAM: stopped: temperature 9000 K in cell 17" in outline.text
    assert "slm_track_200w in SPH" in outline.text and "not a whole JSON file" in outline.text


def test_figure_nine_and_its_table(outline):
    assert "power" in outline.identities and "paper: figure 9" in outline.text
    for number in range(1, 9):
        assert f"paper: figure {number}" in outline.text, f"figure {number}"
    assert re.search(r"Melt-pool width 100 W [\d.]+ μm [\d.]+ μm [+−][\d.]+ %", outline.text)


def test_assumed_values_stand_beside_the_results_that_depend_on_them(outline):
    section = outline.text.split("slm_track_150w Single track")[2].split("slm_track_200w")[0]
    assert "laser.spot_diameter = 160 μm conduction regime" in section
    assert "body.radius" in outline.text.split("What the paper does not state")[1]


def test_an_empty_results_folder_gives_a_page_that_says_so(tmp_path, monkeypatch, browse):
    from cupel import results
    from reports.page import write_page

    monkeypatch.setattr(results, "CASES", tmp_path / "validation_cases")  # where nothing is kept either
    text = Outline(browse(write_page(tmp_path, None, "coarse").as_uri(), "--dump-dom")).text
    assert text.count("not run yet") >= 10 and "0 of 10 comparisons pass" in text
