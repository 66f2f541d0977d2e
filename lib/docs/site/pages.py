#!/usr/bin/env python3
"""pages.py FOLDER OUTPUT: the plain Markdown of lib/docs as pages for Doxygen.

FOLDER is lib/docs; pages that were made elsewhere (the gallery of figures) are given after OUTPUT. A page is read as any
browser of repositories reads it; here `$...$` becomes a formula of Doxygen, links between pages and to examples become
references, `avi::name` in code becomes a link to the reference, comments go. The order of the guide is that of the links in
README.md, which is the front page; the order of the notes that of notes/README.md. OUTPUT also gets layout.xml (what
stands in the navigation) and examples.dox (a page for each program of lib/examples.md).
"""
import html
import pathlib
import re
import shutil
import sys

FRONT = "README"


def slug(title):
    """The anchor that browsers of repositories give to a heading."""
    title = re.sub(r"[`*$\\]", "", title).strip().lower()
    return re.sub(r"[^\w\- ]", "", title).replace(" ", "-")


def quoted(text):
    """Text as an attribute of XML."""
    return html.escape(text, quote=False).replace('"', "&quot;")


class Pages:
    """All pages, each with its source, an identifier and a title."""

    def __init__(self, docs, more):
        self.docs = docs.resolve()
        self.ids, self.titles, self.bases, self.pictures = {}, {}, {}, {}
        for path in sorted([*docs.glob("*.md"), *docs.glob("notes/*.md"), *map(pathlib.Path, more)]):
            path = path.resolve()
            title, given = re.match(r"# (.+?)(?:\s*\{#(\w+)\})?\n", path.read_text()).groups()
            folder = "" if path.parent == self.docs else path.parent.name
            self.ids[path] = given or {"README": folder or "index"}.get(path.stem, path.stem)
            self.titles[path] = title
            # Pages made elsewhere hold what lib/docs/chapters says, with its links.
            self.bases[path] = path.parent if self.docs in path.parents else self.docs / "chapters"
        if len(set(self.ids.values())) != len(self.ids):
            raise SystemExit("pages.py: two pages have the same name: " + ", ".join(map(str, self.ids)))
        self.guide = self.linked(docs / "README.md", lambda target: target.parent == self.docs)
        notes = docs / "notes" / "README.md"
        self.notes = self.linked(notes, lambda target: target.parent == notes.parent.resolve())

    def linked(self, index, wanted):
        """The pages that the entries of a list of contents begin with, in order."""
        found = []
        for target in re.findall(r"^(?:\d+\.|\*) \[[^\]]+\]\(([\w/.-]+\.md)\)", index.read_text(), re.M):
            path = (index.parent / target).resolve()
            if path in self.ids and wanted(path) and path not in found:
                found.append(path)
        return found

    # ---- a page ------------------------------------------------------------------------------------------------------
    def link(self, page, text, target):
        """A link of a page: to a page, a section, an example, a place outside, or a file that the site does not have."""
        if re.match(r"[a-z]+:", target):
            return f"[{text}]({target})"
        file, _, section = target.partition("#")
        path = (self.bases[page] / file).resolve() if file else page
        if path in self.ids:
            return f"[{text}](@ref {self.ids[path]}{'_' + section if section else ''})"
        if path.parent.name == "chapters" and path.suffix == ".md" and path.exists():
            return f"[{text}](@ref chapter_{path.stem})"  # its page on the site is made by gallery.sh
        if path.parent.name == "examples" and path.suffix == ".cpp":
            return f"[{text}](@ref {path.name})"
        if not path.exists():
            raise SystemExit(f"pages.py: {page} links to {target}, which is not there.")
        inside = path.relative_to(self.docs.parents[1])
        return f"{text}" if str(inside) in text else f"{text} (`{inside}`)"

    def picture(self, page, target):
        """The name of a picture in the site: one of the repository's is taken along, figures are found by Doxygen."""
        if "/" not in target:
            return target
        path = (self.bases[page] / target).resolve()
        if not path.exists():
            raise SystemExit(f"pages.py: {page} shows {target}, which is not there.")
        self.pictures[f"{path.parent.name}_{path.name}"] = path
        return f"{path.parent.name}_{path.name}"

    def code(self, text):
        """Inline code; a name of the library becomes a link."""
        if re.fullmatch(r"avi(::\w+)+(\(\))?", text):
            return f"<tt>{html.escape(text)}</tt>"
        if "'" in text and "`" not in text:
            return f"``{text}``"  # Doxygen takes `text' for a quotation
        return None

    def line(self, page, text):
        """One line of text, code and formulas set apart first."""
        kept = []

        def keep(piece):
            kept.append(piece)
            return f"\x00{len(kept) - 1}\x00"

        text = re.sub(r"(`+)(.+?)\1", lambda m: keep(self.code(m[2]) or m[0]), text)
        text = re.sub(r"\$([^$\s](?:[^$]*[^$\s])?)\$", lambda m: keep(rf"\f${m[1]}\f$"), text)
        text = re.sub(r"!\[([^\]]*)\]\(([^)]+)\)", lambda m: keep(f"![{m[1]}]({self.picture(page, m[2])})"), text)
        text = re.sub(r"\[([^\]]+)\]\(([^)\s]+)\)", lambda m: self.link(page, m[1], m[2]), text)
        while "\x00" in text:
            text = re.sub(r"\x00(\d+)\x00", lambda m: kept[int(m[1])], text)
        return text

    def doxygen(self, page):
        """The page as Doxygen reads it."""
        text = re.sub(r"<!--.*?-->(\n(?=```))?", "", page.read_text(), flags=re.S)
        name, out, fenced, formula = self.ids[page], [], False, False
        for number, line in enumerate(text.splitlines()):
            program = None
            if line.lstrip().startswith("```"):
                fenced = not fenced
            elif not fenced and line.strip() == "$$":
                formula = not formula
                line = r"\f[" if formula else r"\f]"
            elif not fenced and not formula:
                heading = re.match(r"(#+) (.+?)(\s*\{#.*\})?$", line)
                line = re.sub(r"\$\$(.+?)\$\$", r"\\f[\1\\f]", line)
                line = self.line(page, line.replace("`", "") if heading else line)  # nor code in a heading's entry
                program = re.fullmatch(r"(#+) \[(.+?)\]\(@ref (.+\.cpp)\)", line)  # Doxygen knows no link in a heading
                if program:
                    line = f"{program[1]} {program[2]}"
                if heading and not heading[3]:
                    label = name if number == 0 else f"{name}_{slug(heading[2])}"
                    line += "" if label == "index" else f" {{#{label}}}"
            out.append(line)
            if program:
                out.append(f"\n[The program](@ref {program[3]})")
        return "\n".join(out) + self.onward(page) + "\n"

    def onward(self, page):
        """Where to go from a page of the guide."""
        order = [(self.docs / "README.md"), *self.guide]
        if page not in order[1:]:
            return ""
        at, links = order.index(page), []
        for step, css in ((-1, "back"), (1, "next")):
            if 0 < at + step < len(order):
                other = order[at + step]
                links.append(f'<a class="{css}" href="{self.ids[other]}.html">{html.escape(self.titles[other])}</a>')
        return f'\n\n\\htmlonly <nav class="onward">{"".join(links)}</nav> \\endhtmlonly\n'

    # ---- what belongs to all -----------------------------------------------------------------------------------------
    def layout(self, chapters):
        """The navigation: guide, examples, figures, notes; the reference last."""
        def tab(path, title=None):
            return f'<tab type="user" url="@ref {self.ids[path]}" title="{quoted(title or self.titles[path])}"/>'

        def group(title, url, paths):
            return f'<tab type="usergroup" url="{url}" title="{title}">{"".join(map(tab, paths))}</tab>'

        named = {self.ids[path]: path for path in self.ids}
        figures = [path for path in chapters if self.ids[path] != "gallery"]
        apart = [named[name] for name in ("examples", "interface") if name in named]
        body = "".join([
            '<tab type="mainpage" visible="yes" title="avi"/>',
            group("Guide", "", [path for path in self.guide if path not in apart]),
            *[tab(path) for path in apart],
            group("Figures", "@ref gallery", figures) if "gallery" in named else "",
            group("Notes", "@ref notes", self.notes) if self.notes else "",
            '<tab type="usergroup" url="" title="Reference">'
            '<tab type="classlist" visible="yes" title="Classes"/><tab type="namespacemembers" visible="yes" title="Functions"/>'
            '<tab type="filelist" visible="yes" title="Headers"/></tab>'])
        return f'<doxygenlayout version="1.0"><navindex>{body}</navindex></doxygenlayout>\n'

    def examples(self, page):
        """A page for each program: what the gallery says of it, and what it prints."""
        out = []
        for part in re.split(r"^(?=## )", page.read_text(), flags=re.M)[1:]:
            heading, _, text = part.partition("\n")
            for program in re.findall(r"\(\.\./examples/(\w+)\.cpp\)", heading):
                text = re.sub(r"<!--.*?-->|!\[.*?\]\(.*?\)|```.*?```", "", text, flags=re.S)
                text = "\n".join(self.line(page, line) for line in text.strip().splitlines())
                prints = f"It prints\n\\verbinclude {program}.out\n" if \
                    (self.docs.parent / "examples" / f"{program}.out").exists() else ""
                out.append(f"/**\n\\example {program}.cpp\n\\details\n{text}\n\n{prints}*/\n")
        return "\n".join(out)


def main(folder, output, *more):
    pages, output = Pages(pathlib.Path(folder), more), pathlib.Path(output)
    output.mkdir(parents=True, exist_ok=True)
    for old in output.glob("*"):
        old.unlink()
    for page, name in pages.ids.items():
        (output / f"{name}.md").write_text(pages.doxygen(page))
        if name == "examples":
            (output / "examples.dox").write_text(pages.examples(page))
    for name, path in pages.pictures.items():
        shutil.copyfile(path, output / name)
    (output / "layout.xml").write_text(pages.layout([pathlib.Path(path).resolve() for path in more]))


if __name__ == "__main__":
    main(*sys.argv[1:])
