# SPDX-License-Identifier: MIT
"""The site of docs/reference/site.py: links and anchors have targets, every page and every function is there, markup is
understood, and nothing is wider than a phone.

    site_test.py SOURCE OUT PLAY [CHROMIUM]
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser

SOURCE, OUT, PLAY, *CHROMIUM = sys.argv[1:]
PHONE = 390  # pixels


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.text, self.headings, self._skipped = [], [], [], 0, 0
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        self.links += [found[name] for name in ("href", "src") if name in found]
        self.headings += tag == "h1"
        self._skipped += tag in ("pre", "code", "style")

    def handle_endtag(self, tag):
        self._skipped -= tag in ("pre", "code", "style")

    def handle_data(self, data):
        if not self._skipped:
            self.text.append(data)


def faults_of(name, page, pages):
    if len(set(page.ids)) != len(page.ids):
        yield "{}: an id twice".format(name)
    if page.headings != 1:
        yield "{}: {} headings of level 1".format(name, page.headings)
    for link in page.links:
        if re.match(r"(https?|data|mailto):", link):
            continue
        path, _, anchor = link.partition("#")
        path = path or name
        if not os.path.exists(os.path.join(OUT, path)):
            yield "{}: no {}".format(name, link)
        elif anchor and anchor not in pages[path].ids:
            yield "{}: no anchor {}".format(name, link)
    for raw in re.findall(r"\]\([\w./#-]+\)|^#+ .*|```|\*\*\w", "".join(page.text), re.M):
        yield "{}: markup {!r}".format(name, raw)


def missing(pages):
    for path in glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True):
        name = os.path.relpath(path, os.path.join(SOURCE, "docs"))[:-3].replace("/README", "").replace("/", "-")
        if name + ".html" not in pages:
            yield "no page of {}".format(path)
    with open(os.path.join(SOURCE, "include", "topoadapt.h"), encoding="utf-8") as file:
        header = file.read()
    functions = set(re.findall(r"^TPA_API .*?\b(tpa_\w+)\(", header, re.M)) | set(
        re.findall(r"struct (tpa_\w+) {", header)
    )
    assert len(functions) > 50
    for name in sorted(functions - set(pages["api.html"].ids)):
        yield "api.html: no {}".format(name)
    for path in glob.glob(os.path.join(SOURCE, "examples", "*.c")):
        if "program-{}-c.html".format(os.path.basename(path)[:-2]) not in pages:
            yield "no page of {}".format(path)


# Each page in a frame of a phone's width, one after the other: how wide is what it shows?
MEASURE = """<!doctype html><pre id="found"></pre><script>
const names = {names}, found = {{}};
(async () => {{
  for (const name of names) {{
    const frame = document.createElement("iframe");
    Object.assign(frame.style, {{ width: "{phone}px", height: "700px", border: "0" }});
    frame.src = {folder} + name;
    document.body.append(frame);
    await new Promise((go) => (frame.onload = go));
    const page = frame.contentDocument.documentElement, style = frame.contentWindow.getComputedStyle(frame.contentDocument.body);
    found[name] = [page.scrollWidth, style.backgroundColor, style.color];
    frame.remove();
  }}
  document.getElementById("found").textContent = JSON.stringify(found);
}})();
</script>"""


def shown(names, dark):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "measure.html")
        with open(path, "w", encoding="utf-8") as file:
            there = json.dumps("file://" + os.path.abspath(OUT) + "/")
            file.write(MEASURE.format(names=json.dumps(names), phone=PHONE, folder=there))
        command = [CHROMIUM[0], "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files"]
        command += ["--user-data-dir=" + folder, "--virtual-time-budget=600000", "--dump-dom"]
        command += ["--blink-settings=preferredColorScheme=" + ("0" if dark else "1")]
        done = subprocess.run(
            [*command, "file://" + path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=300
        )
    found = re.search(r'<pre id="found">(.*?)</pre>', done.stdout.decode(), re.S)
    return json.loads(found[1])


def luminance(colour):
    parts = [int(part) / 255 for part in re.findall(r"\d+", colour)[:3]]
    return sum(
        w * (p / 12.92 if p <= 0.04 else ((p + 0.055) / 1.055) ** 2.4) for w, p in zip((0.2126, 0.7152, 0.0722), parts)
    )


def looks(pages):
    backgrounds = set()
    for dark in (False, True):
        for name, (width, background, colour) in shown(sorted(pages), dark).items():
            if width > PHONE:
                yield "{}: {} pixels wide on a phone".format(name, width)
            low, high = sorted((luminance(background), luminance(colour)))
            if (high + 0.05) / (low + 0.05) < 7:  # WCAG, level AAA
                yield "{}: {} on {}".format(name, colour, background)
            backgrounds.add((dark, background))
    if len({background for _, background in backgrounds}) != 2:
        yield "light and dark are alike: {}".format(backgrounds)


def main():
    here = os.path.join(SOURCE, "docs", "reference", "site.py")
    subprocess.run([sys.executable, "-B", here, SOURCE, OUT, PLAY], check=True)
    pages = {
        os.path.basename(path): Page(path) for path in glob.glob(os.path.join(OUT, "*.html")) if "play.html" not in path
    }
    if os.path.exists(PLAY):
        assert os.path.getsize(os.path.join(OUT, "play.html")) > 1000000
    faults = [fault for name, page in pages.items() for fault in faults_of(name, page, {**pages, "play.html": None})]
    faults += missing(pages)
    if CHROMIUM and os.path.exists(CHROMIUM[0]):
        faults += looks(pages)
    else:
        print("no chromium: the site is not looked at")
    size = sum(
        os.path.getsize(path)
        for path in glob.glob(os.path.join(OUT, "**", "*"), recursive=True)
        if os.path.isfile(path)
    )
    print("{} pages, {:.1f} MB".format(len(pages), size / 1e6))
    sys.exit("\n".join(faults) if faults or len(pages) < 50 else 0)


main()
