# SPDX-License-Identifier: MIT
"""Makes the site: the pages, topoadapt.h, the small programs, the pictures, and the page to play with, if there is one.

    site.py SOURCE OUT [PLAY]

PLAY: the built page of examples/web, or a path where none is. Needs markdown-it-py and Pygments. A link without a target
is an error.
"""
import glob
import html
import os
import re
import shutil
import sys

sys.dont_write_bytecode = True
import header  # noqa: E402
from markdown_it import MarkdownIt  # noqa: E402
from pygments import highlight  # noqa: E402
from pygments.formatters import HtmlFormatter  # noqa: E402
from pygments.lexers import get_lexer_by_name  # noqa: E402
from pygments.util import ClassNotFound  # noqa: E402

# The contents, in order.
CONTENTS = (
    ("Start", ("README.md", "docs/guide.md")),
    ("Small programs", ("docs/cpp.md",)),
    (
        "Special needs",
        tuple(
            "docs/{}.md".format(name)
            for name in (
                "solver",
                "realtime",
                "segmentation",
                "limits",
                "attributes",
                "determinism",
                "porting",
                "safety",
                "versioning",
                "batch",
            )
        ),
    ),
    (
        "Packages",
        (
            "examples/python/README.md",
            "examples/rust/README.md",
            "examples/rust/*/README.md",
            "examples/web/README.md",
            "examples/web/*/README.md",
            "examples/blender/README.md",
            "packaging/README.md",
        ),
    ),
    ("Larger programs", ("examples/*/README.md",)),
    ("Background", ("docs/architecture.md", "docs/guarantees.md", "docs/*.md")),
    ("Project", ("CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md")),
    ("Notes", ("docs/notes/README.md", "docs/notes/*.md")),
)
EXAMPLES = ("examples/*.c", "examples/*.cpp", "examples/*.h", "include/*.hpp")
API = "api.html"


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def slug(title, used):
    """The anchors of GitHub."""
    name = re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
    again = used.count(name)
    used.append(name)
    return "{}-{}".format(name, again) if again else name


def file_of(path):
    name = re.sub(r"^docs/|/README$|^examples/(?=.*\.)", "", os.path.splitext(path)[0])
    if path.endswith((".c", ".cpp", ".h", ".hpp")):
        name = "program-" + os.path.basename(path).replace(".", "-")
    return "index.html" if path == "README.md" else name.replace("/", "-").lower() + ".html"


def code_block(code, language):
    try:
        lexer = get_lexer_by_name(language or "text")
    except ClassNotFound:
        lexer = get_lexer_by_name("text")
    return '<div class="code">{}</div>'.format(highlight(code, lexer, HtmlFormatter(nowrap=False)))


class Site:
    def __init__(self, source, play):
        self.source, self.play, self.broken, self.pictures = source, play, set(), set()
        self.contents, self.pages = [], {}
        for title, patterns in CONTENTS:
            found = []
            for pattern in patterns:
                paths = [os.path.relpath(p, source) for p in sorted(glob.glob(os.path.join(source, pattern)))]
                found += [path for path in paths if path not in self.pages and path not in found]
            self.pages.update((path, read(os.path.join(source, path))) for path in found)
            self.contents.append((title, found))
        paths = [os.path.relpath(p, source) for e in EXAMPLES for p in sorted(glob.glob(os.path.join(source, e)))]
        self.programs = {path: read(os.path.join(source, path)) for path in paths}
        self.header = read(os.path.join(source, "include", "topoadapt.h"))
        self.parts = header.sections(self.header)
        self.names = {name for _, items in self.parts for names, _, _ in items for name in names}
        self.markdown = MarkdownIt("commonmark", {"highlight": lambda code, language, _: code_block(code, language)})
        self.markdown.enable("table")
        self.headings = {path: self._read_headings(path) for path in self.pages}
        self.anchors = {path: {anchor for anchor, _, _ in found} for path, found in self.headings.items()}

    # ---------------------------------------------------------------- pages

    def _read_headings(self, path):
        """(anchor, level, words) of each heading."""
        used, tokens = [], self.markdown.parse(self.pages[path])
        return [
            (slug(words.content.replace("`", ""), used), int(token.tag[1]), words.content.replace("`", ""))
            for token, words in zip(tokens, tokens[1:])
            if token.type == "heading_open"
        ]

    def title(self, path):
        return next((words for _, level, words in self.headings[path] if level == 1), path)

    def body(self, path):
        """The page as HTML, with links to pages of the site."""
        tokens, used = self.markdown.parse(re.sub(r"<!--.*?-->\n", "", self.pages[path], flags=re.S)), []
        for place, token in enumerate(tokens):
            if token.type == "heading_open":
                token.attrSet("id", slug(tokens[place + 1].content.replace("`", ""), used))
            if token.type == "inline":
                self._link_inline(path, token)
        text = self.markdown.renderer.render(tokens, self.markdown.options, {})
        text = re.sub(r"<pre><code[^>]*>(<div class=\"code\">.*?</div>\n?)</code></pre>", r"\1", text, flags=re.S)
        return re.sub(r"(<table>.*?</table>)", r'<div class="wide">\1</div>', text, flags=re.S)

    def _link_inline(self, path, token):
        linked, kept = 0, []
        for child in token.children:
            if child.type == "link_open":
                linked += 1
                child.attrSet("href", self.target(path, child.attrGet("href")))
            elif child.type == "link_close":
                linked -= 1
            elif child.type == "image":
                child.attrSet("src", self._picture(path, child.attrGet("src")))
                child.attrSet("loading", "lazy")
            elif child.type == "code_inline" and not linked:
                name = re.fullmatch(r"(\w+)(\(\))?", child.content)
                if name and name[1] in self.names:
                    child.type, child.content = "html_inline", self._name_link(name[1], child.content)
            kept.append(child)
        # Sources that are no page of the site have no link.
        token.children, open_links = [], []
        for child in kept:
            if child.type == "link_open":
                open_links.append(child.attrGet("href") is not None and child.attrGet("href") != "")
            if child.type in ("link_open", "link_close"):
                keep = open_links[-1]
                if child.type == "link_close":
                    open_links.pop()
                if not keep:
                    continue
            token.children.append(child)

    def _name_link(self, name, words):
        return '<a href="{}#{}"><code>{}</code></a>'.format(API, name, html.escape(words))

    def target(self, page, link):
        """The address within the site; empty for a source that is no page."""
        if re.match(r"(https?|mailto):", link):
            return link
        path, _, anchor = link.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if path in self.pages:
            if anchor and anchor not in self.anchors[path]:
                self.broken.add("{}: {}".format(page, link))
            return file_of(path) + ("#" + anchor if anchor else "")
        if not os.path.exists(os.path.join(self.source, path)):
            self.broken.add("{}: {}".format(page, link))
        if path == "include/topoadapt.h":
            return API
        if path in self.programs:
            return file_of(path)
        if path == "LICENSE":
            return "LICENSE.txt"
        return ""

    def _picture(self, page, link):
        path = os.path.normpath(os.path.join(self.source, os.path.dirname(page), link))
        if not os.path.exists(path):
            self.broken.add("{}: {}".format(page, link))
        self.pictures.add(path)
        return "pictures/" + os.path.basename(path)

    # ---------------------------------------------------------------- the interface

    def prose(self, text):
        """A comment as paragraphs, with names of the interface as links. Indented lines stay as they are."""
        out = []
        for paragraph in re.split(r"\n\s*\n", text):
            lines = paragraph.split("\n")
            for verbatim, group in _runs(lines):
                if verbatim:
                    out.append("<pre>{}</pre>".format(html.escape("\n".join(group))))
                else:
                    words = html.escape(" ".join(group).strip())
                    words = re.sub(
                        r"\b(tpa_\w+|TPA_\w+)\b",
                        lambda m: self._name_link(m[1], m[1]) if m[1] in self.names else "<code>{}</code>".format(m[1]),
                        words,
                    )
                    out.append("<p>{}</p>".format(words) if words else "")
        return "\n".join(out)

    def api(self):
        head, rules = header.rules(self.header)
        out = ["<h1>topoadapt.h</h1>", self.prose(head), '<h2 id="rules">Rules for all functions</h2>']
        out += ["<h3>{}</h3>{}".format(title, self.prose(text)) for title, text in rules]
        headings = [("rules", 2, "Rules for all functions")]
        used = []
        for title, items in self.parts:
            anchor = slug(title, used)
            headings.append((anchor, 2, title))
            out.append('<h2 id="{}">{}</h2>'.format(anchor, html.escape(title)))
            for names, comment, code in items:
                headings += [(name, 3, name) for name in names[:1]]
                anchors = "".join('<a id="{}"></a>'.format(name) for name in names[1:])
                code = code_block(re.sub(r"\bTPA_API ", "", code), "c")
                out.append(
                    '<section class="item"><h3 id="{0}">{0}</h3>{1}{2}{3}</section>'.format(
                        names[0], anchors, code, self.prose(comment)
                    )
                )
        return "\n".join(out), headings

    # ---------------------------------------------------------------- the frame

    def _menu(self, here):
        def entry(name, words):
            mark = ' aria-current="page"' if name == here else ""
            return '<li><a href="{}"{}>{}</a></li>'.format(name, mark, html.escape(words))

        parts = []
        for title, paths in self.contents:
            entries = [entry(file_of(path), "Overview" if path == "README.md" else self.title(path)) for path in paths]
            if title == "Start":
                entries.append(entry(API, "topoadapt.h"))
                entries += [entry("play.html", "Play with it")] if self.play else []
            if title == "Small programs":
                entries += [entry(file_of(path), os.path.basename(path)) for path in self.programs]
            inside = here in "".join(entries) and "aria-current" in "".join(entries)
            is_open = " open" if inside or title in ("Start", "Packages") else ""
            parts.append(
                "<details{}><summary>{}</summary><ul>{}</ul></details>".format(is_open, title, "".join(entries))
            )
        return "".join(parts)

    def frame(self, name, title, body, headings, version):
        on_page = "".join(
            '<li class="level{}"><a href="#{}">{}</a></li>'.format(level, anchor, html.escape(words))
            for anchor, level, words in headings
            if level in (2, 3)
        )
        aside = '<aside class="here"><h2>On this page</h2><ul>{}</ul></aside>'.format(on_page) if on_page else ""
        return TEMPLATE.format(title=html.escape(title), version=version, menu=self._menu(name), body=body, aside=aside)

    def write(self, out):
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(os.path.join(out, "pictures"))
        version = ".".join(
            re.search(r"TPA_VERSION_{} (\d+)".format(part), self.header)[1] for part in ("MAJOR", "MINOR", "PATCH")
        )
        made = {}
        for path in self.pages:
            made[file_of(path)] = (self.title(path), self.body(path), self.headings[path])
        for path, text in self.programs.items():
            name = os.path.basename(path)
            made[file_of(path)] = (
                name,
                "<h1>{}</h1>{}".format(name, code_block(text, "cpp" if path.endswith("pp") else "c")),
                [],
            )
        made[API] = ("topoadapt.h", *self.api())
        for name, (title, body, headings) in made.items():
            with open(os.path.join(out, name), "w", encoding="utf-8") as file:
                file.write(self.frame(name, title, body, headings, version))
        for path in self.pictures:
            if os.path.exists(path):
                shutil.copy(path, os.path.join(out, "pictures"))
        shutil.copy(os.path.join(self.source, "LICENSE"), os.path.join(out, "LICENSE.txt"))
        shutil.copy(os.path.join(self.source, "docs", "reference", "site.css"), out)
        if self.play:
            shutil.copy(self.play, os.path.join(out, "play.html"))


def _runs(lines):
    """Runs of lines that are indented, and of lines that are not."""
    runs = []
    for line in lines:
        verbatim = line.startswith("  ")
        if runs and runs[-1][0] == verbatim:
            runs[-1][1].append(line)
        else:
            runs.append((verbatim, [line]))
    return runs


TEMPLATE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{title} · topoadapt</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="site.css">
</head>
<body>
<a class="skip" href="#content">To the page</a>
<header>
<a class="name" href="index.html">topoadapt</a><span class="version">{version}</span>
<nav aria-label="Main"><a href="guide.html">Guide</a><a href="api.html">Interface</a><a href="changelog.html">Changes</a></nav>
<label class="menu" for="menu">Contents</label>
</header>
<input type="checkbox" id="menu" aria-label="Contents">
<nav class="contents" aria-label="Contents">{menu}</nav>
<main id="content">{body}</main>
{aside}
</body>
</html>
"""


def main():
    source, out, *play = sys.argv[1:]
    site = Site(os.path.abspath(source), play[0] if play and os.path.exists(play[0]) else None)
    site.write(out)
    if site.broken:
        sys.exit("links without a target:\n  " + "\n  ".join(sorted(site.broken)))


main()
