# SPDX-License-Identifier: MIT
"""topoadapt.h as sections of declarations with their comments, for the page of the interface."""
import re

_SECTION = re.compile(r"/\* -{9,} (.*) \*/")
_NAME = re.compile(
    r"TPA_API [^;(]*?\b(tpa_\w+)\(|(?:enum|struct) (tpa_\w+) {|typedef \w+(?: \w+)? (tpa_\w+);|#define (TPA_\w+)"
)


def rules(text):
    """The comment at the head: its first part, its example, and its rules as (title, text)."""
    comment = re.search(r"/\* topoadapt: .*?\*/", text, re.S)[0]
    lines = [re.sub(r"^/?\s?\*/? ?", "", line) for line in comment.split("\n")]
    start = next(i for i, line in enumerate(lines) if line.startswith("RULES FOR ALL"))
    found, last = [], None
    for line in lines[start + 1 :]:
        title = re.match(r"([A-Z][a-z]+) {2,}(\S.*)", line)
        if title:
            found.append([title[1], [title[2]]])
            last = found[-1]
        elif last is not None:
            last[1].append(line[11:] if line.startswith(" " * 11) else line.strip())
    return "\n".join(lines[:start]), [(title, "\n".join(body)) for title, body in found]


def _blocks(text):
    """Comments and declarations, with no blank line within braces as a bound."""
    block, depth = [], 0
    for line in text.split("\n"):
        code = re.sub(r"/\*.*?(\*/|$)", "", line)
        depth += code.count("{") - code.count("}")
        if line.strip() or depth > 0:
            block.append(line)
        elif block:
            yield "\n".join(block)
            block = []
    if block:
        yield "\n".join(block)


def sections(text):
    """(title, items) for each part of the header. An item is (names, comment, code)."""
    found, held = [], ""
    body = text[_SECTION.search(text).start() : text.rindex("#ifdef __cplusplus")]
    for block in _blocks(body):
        section = _SECTION.match(block)
        if section:
            found.append((section[1][0].upper() + section[1][1:], []))
            block = block[section.end() :].strip("\n")
        comment = re.match(r"/\*(.*?)\*/\n?", block, re.S)
        words, code = "", block
        if comment:
            words = re.sub(r"\n \* ?", "\n", comment[1]).strip()
            code = block[comment.end() :]
        if not code.strip():
            held = words
            continue
        names = [name for groups in _NAME.findall(code) for name in groups if name]
        if names:
            found[-1][1].append((list(dict.fromkeys(names)), "\n\n".join(filter(None, (held, words))), code))
        held = ""
    return found
