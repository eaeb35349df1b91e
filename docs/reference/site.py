# SPDX-License-Identifier: MIT
"""Writes the input of Doxygen for the reference site: the header with its comments in Doxygen's form, the pages with
links and headings that Doxygen 1.9 resolves, the examples, and the pictures. A link without a target is an error.

site.py SOURCE OUT; then doxygen in OUT makes OUT/html.
"""
import glob
import os
import re
import shutil
import sys

# In the order of the site's contents.
PAGES = ("README.md", "docs/guide.md", "docs/guide/*.md", "docs/*.md", "examples/*/README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md")
EXAMPLES = ("examples/*.c", "examples/*.h")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


# ---------------------------------------------------------------- the header

def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


# The comment at the head: its rules as paragraphs with titles, indented lines as they are.
def rules(comment):
    lines = [re.sub(r"^ ?\*? ?", "", line, count=1) for line in comment[2:-2].split("\n")]
    out, as_is, indent = [], False, 4
    for line in lines:
        title = re.match(r"([A-Z][a-z]+) {2,}(\S.*)", line)
        if line.startswith("RULES FOR ALL"):
            line = "@section rules Rules for all functions\n"
            indent = 13
        verbatim = len(line) - len(line.lstrip()) >= indent and not title
        if verbatim != as_is:
            out.append("@verbatim" if verbatim else "@endverbatim")
            as_is = verbatim
        if title:
            line = f"\n@par {title[1]}\n{escape(title[2])}"
        out.append(line[indent:] if verbatim else line if title else escape(line.strip()))
    return "/** @file topoadapt.h\n" + "\n".join(out) + "\n*/"


def header(text):
    groups = 0
    parts, place = [], 0
    for match in re.finditer(r"/\*.*?\*/", text, re.S):
        parts.append(text[place:match.start()])
        place = match.end()
        comment = match[0]
        line = text[text.rfind("\n", 0, match.start()) + 1:match.start()]
        section = re.match(r"/\* -{9,} (.*) \*/", comment)
        if comment.startswith("/* topoadapt: "):
            comment = rules(comment)
        elif section:
            closed = "/** @} */\n" if groups else ""
            groups += 1
            title = section[1][0].upper() + section[1][1:]
            comment = f"{closed}/** @defgroup part{groups} {title}\n@{{ */"
        elif line.strip():
            comment = "/**< @brief" + escape(comment[2:])
        elif re.match(r"\s*(typedef|enum|TPA_API|#define TPA_)", text[place:]):
            brief, rest = re.match(r"(.+?\.(?=\s+[A-Z]|\s*\Z)|.+)(.*)", comment[3:-2], re.S).groups()
            comment = f"/** @brief {escape(brief)}\n *\n *{escape(rest)}*/"
        parts.append(comment)
    out = "".join(parts) + text[place:]
    end = out.rindex("#ifdef __cplusplus")
    return out[:end] + "/** @} */\n" + out[end:]


# ---------------------------------------------------------------- the pages

# The anchors of GitHub.
def slug(title, used):
    name = re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
    again = used.count(name)
    used.append(name)
    return f"{name}-{again}" if again else name


def page_id(path):
    name = os.path.splitext(path)[0].replace("docs/", "").replace("/", "-").lower()
    return "start" if name == "readme" else name


# Splits a page into blocks of code and text.
def blocks(text):
    for part in re.split(r"(^```.*?^```$)", text, flags=re.S | re.M):
        if part.startswith("```"):
            yield True, part
            continue
        for piece in re.split(r"((?:^(?:    |\t).*\n|^\n(?=(?:    |\t)))+)", part, flags=re.M):
            yield bool(re.match(r"\n*(    |\t)", piece)) and "\n    |" not in piece, piece


class Site:
    def __init__(self, source):
        self.source = source
        self.pages, self.anchors, self.broken = {}, {}, []
        for pattern in PAGES:
            for path in sorted(glob.glob(os.path.join(source, pattern))):
                self.pages[os.path.relpath(path, source)] = read(path)
        self.examples = [os.path.relpath(p, source) for e in EXAMPLES for p in sorted(glob.glob(os.path.join(source, e)))]
        for path, text in self.pages.items():
            used = []
            self.anchors[path] = {slug(title, used) for code, part in blocks(text) if not code
                                  for title in re.findall(r"^#+ (.+)$", part, re.M)}
        names = set(re.findall(r"\b(tpa_[a-z_]+)\(", read(os.path.join(source, "include/topoadapt.h"))))
        names |= set(re.findall(r"struct (tpa_[a-z_]+) {", read(os.path.join(source, "include/topoadapt.h"))))
        self.names = names

    # A link in the page: to a page, a heading or an example of the site; else the text alone.
    def link(self, page, text, target):
        if re.match(r"https?:", target):
            return f"[{text}]({target})"
        path, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        words = text.replace('"', "'").replace("`", "")
        if path in self.pages:
            if anchor and anchor not in self.anchors[path]:
                self.broken.append(f"{page}: {target}")
            return f'@ref {page_id(path)}{"--" + anchor if anchor else ""} "{words}"'
        if not os.path.exists(os.path.join(self.source, path)):
            self.broken.append(f"{page}: {target}")
        if path == "include/topoadapt.h":
            return f'@ref topoadapt.h "{words}"'
        if path in self.examples:
            return f'@ref {os.path.basename(path)} "{words}"'
        if path == "LICENSE":
            return words
        return f"{words} (<tt>{path}</tt>)" if path not in words else f"<tt>{words}</tt>"

    def convert(self, page, text):
        used = []

        def heading(match):
            anchor = slug(match[2], used)
            ident = page_id(page) if match[1] == "#" else f"{page_id(page)}--{anchor}"
            return f"{match[1]} {match[2]} {{#{ident}}}"

        def picture(match):
            if not os.path.exists(os.path.join(self.source, os.path.dirname(page), match[2])):
                self.broken.append(f"{page}: {match[2]}")
            return f"![{match[1]}]({os.path.basename(match[2])})"

        def name(match):
            return f'@ref {match[1]} "{match[1]}"' if match[1] in self.names else match[0]

        out = []
        for code, part in blocks(text):
            if not code:
                part = re.sub(r"<!--.*?-->\n", "", part, flags=re.S)
                part = re.sub(r"^(#+) (.+)$", heading, part, flags=re.M)
                part = re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", picture, part)
                part = re.sub(r"(?<!!)\[([^\]\n]*(?:\n[^\]\n]*)?)\]\(([^)\s]*)\)",
                              lambda m: self.link(page, m[1].replace("\n", " "), m[2]), part)
                part = re.sub(r"(?<!`)`(tpa_[a-z_]+)`(?!`)", name, part)
            out.append(part)
        return "".join(out)


def example(path, text):
    comment = re.search(r"^/\* (?!SPDX)(.*?)\*/|^// (?!SPDX)(.*)$", text, re.S | re.M)
    words = " ".join((comment[1] or comment[2]).replace("\n *", "\n").split()) if comment else ""
    return f"/** @example {os.path.basename(path)}\n{escape(words)}\n*/\n"


def main():
    source, out = sys.argv[1:]
    shutil.rmtree(os.path.join(out, "input"), ignore_errors=True)
    site = Site(source)
    text = read(os.path.join(source, "include", "topoadapt.h"))
    write(os.path.join(out, "input", "topoadapt.h"), header(text))
    for path, page in site.pages.items():
        write(os.path.join(out, "input", path), site.convert(path, page))
    listing = "".join(example(path, read(os.path.join(source, path))) for path in site.examples)
    write(os.path.join(out, "input", "examples.dox"), listing)
    for folder, patterns in (("code", EXAMPLES), ("pictures", [f"docs/pictures/*.{kind}" for kind in ("svg", "png", "gif", "webp")])):
        os.makedirs(os.path.join(out, "input", folder))
        for pattern in patterns:
            for path in glob.glob(os.path.join(source, pattern)):
                shutil.copy(path, os.path.join(out, "input", folder))
    if site.broken:
        sys.exit("links without a target:\n  " + "\n  ".join(sorted(set(site.broken))))
    version = ".".join(re.search(f"TPA_VERSION_{part} (\\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))
    here = os.path.join(source, "docs", "reference")
    inputs = " ".join("input/" + path for path in [*site.pages, "topoadapt.h", "examples.dox"])
    settings = f"INPUT = {inputs}\nPROJECT_NUMBER = {version}\n"
    write(os.path.join(out, "Doxyfile"), read(os.path.join(here, "Doxyfile")) + settings)
    shutil.copy(os.path.join(here, "site.css"), out)


main()
