#!/usr/bin/env python3
"""check.py SITE [BROWSER]: is a folder of web pages whole? Prints what is not and ends with status 1.

Every link and every picture of every page leads to a file of the folder, every anchor to a place in it; no reference is left
as Doxygen reads it, and no mark of code; nothing is loaded from elsewhere, neither from the network nor from this disk. With a
BROWSER (chromium) every page with formulas, every guide page and every note is opened in a window of 390 pixels, served over
http: formulas have to be set, without an error, no text may stand out to the right, no picture may be missing, and tables of
guide pages have to fit, but for those with formulas. Guide pages are opened in one of 1280 pixels, too, where no line of
code is cut off either, and one page once more from the disk.
"""
import html.parser
import http.server
import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import urllib.parse

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]


class Page(html.parser.HTMLParser):
    """Links, what is loaded, and anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors, self.unresolved = [], [], set(), False
        self.feed(text)

    def handle_data(self, text):
        self.unresolved |= "@ref " in text or "`" in text

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if value is None:
                continue
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name == "href" and tag in ("a", "area"):
                self.links.append(value)
            elif name in ("href", "src", "data"):
                self.loaded.append(value)


def link_problems(site):
    """What is wrong with links and with what pages load."""
    pages = {path.name: Page(path.read_text(errors="replace")) for path in site.glob("*.html")}
    for name, page in sorted(pages.items()):
        if page.unresolved and not name.endswith("_source.html"):
            yield f"{name} has a reference or a mark of code that Doxygen left as it is"
        for target in page.links + page.loaded:
            url = urllib.parse.urlsplit(target)
            if url.scheme in ("http", "https", "mailto", "javascript"):
                if target in page.loaded and url.scheme != "javascript":
                    yield f"{name} loads {target} from elsewhere"
                continue
            if url.scheme or target.startswith("/"):
                yield f"{name} has {target}, which is no address inside of the site"
                continue
            file = urllib.parse.unquote(url.path) or name
            if not (site / file).exists():
                yield f"{name} leads to {target}, which is not there"
            elif url.fragment == "nested-classes":
                continue  # Doxygen's own heading, missing where all nested classes are private
            elif url.fragment and file in pages and urllib.parse.unquote(url.fragment) not in pages[file].anchors:
                yield f"{name} leads to {target}: no such place in {file}"


LOOK = """<!DOCTYPE html><meta charset="utf-8"><body><script>
const pages = %s, problems = [];
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
async function opened(page, width) {
  const frame = document.createElement("iframe");
  frame.width = width; frame.height = 800;
  const loaded = new Promise((done) => { frame.onload = done; });
  frame.src = page;
  document.body.append(frame);
  await loaded;
  await wait(150);
  return [frame, frame.contentDocument.querySelector("div.contents") || frame.contentDocument.body];
}
function cutOff(page, width, body, kinds) {
  for (const node of body.querySelectorAll(kinds))
    if (node.scrollWidth > node.clientWidth + 1 && !node.querySelector(".katex"))
      problems.push(page + ": cut off at " + width + " pixels: " + node.textContent.trim().slice(0, 60));
}
async function look(page) {
  const [frame, body] = await opened(page, 390);
  const copy = body.cloneNode(true);
  copy.querySelectorAll("pre, code, .fragment, .katex, script").forEach((node) => node.remove());
  if (/\\\\[(\\[]/.test(copy.textContent)) problems.push(page + ": a formula is not set");
  body.querySelectorAll(".katex-error").forEach((node) => problems.push(page + ": " + node.title));
  body.querySelectorAll("img").forEach((node) => { if (!node.naturalWidth) problems.push(page + ": no picture " + node.src); });
  for (const node of body.querySelectorAll(".textblock > *")) {
    if (node.getBoundingClientRect().right > 392) { problems.push(page + ": <" + node.tagName + "> stands out: " + node.textContent.slice(0, 60)); break; }
  }
  const set = body.querySelectorAll(".katex").length;
  const guide = frame.contentDocument.querySelector("nav.onward");
  if (guide) cutOff(page, 390, body, "div.wide");
  frame.remove();
  if (guide) {
    const [wide, text] = await opened(page, 1280);
    cutOff(page, 1280, text, "div.wide, .fragment");
    wide.remove();
  }
  return set;
}
(async () => {
  let set = 0, next = 0;
  const some = async () => { while (next < pages.length) { const found = await look(pages[next++]); set += found; } };
  await Promise.all([some(), some(), some(), some()]);
  await fetch("/report", {method: "POST", body: JSON.stringify({set, problems})});
})();
</script></body>"""


def browser_problems(site, browser):
    """What a browser sees: the number of formulas that are set, and problems."""
    pages = [path.name for path in sorted(site.glob("*.html")) if not path.name.endswith("_source.html")
             and any(mark in path.read_text(errors="replace") for mark in ("\\(", "\\[", 'class="onward"'))]
    report, arrived = {}, threading.Event()

    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *arguments):
            super().__init__(*arguments, directory=str(site))

        def do_GET(self):
            if self.path != "/look":
                return super().do_GET()
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write((LOOK % json.dumps(pages)).encode())

        def do_POST(self):
            report.update(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self.send_response(204)
            self.end_headers()
            arrived.set()

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.handle_error = lambda *_: None  # a page that is left while it loads
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        run = subprocess.Popen([browser, *FLAGS, f"--user-data-dir={profile}", "--remote-debugging-port=0",
                                f"http://127.0.0.1:{server.server_port}/look"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        done = arrived.wait(300)
        run.terminate()
        run.wait()
    server.shutdown()
    if not done:
        return 0, ["the browser gave no answer within 300 seconds"]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        page = next((name for name in ("time_in_h.html", *pages) if (site / name).exists()))
        seen = subprocess.run([browser, *FLAGS, f"--user-data-dir={profile}", "--virtual-time-budget=3000", "--dump-dom",
                               (site / page).as_uri()], capture_output=True, text=True, timeout=120).stdout
        if 'class="katex"' not in seen:
            report["problems"].append(f"{page}, opened from the disk, has no formula set")
    return report["set"], report["problems"]


def main(folder, browser=None):
    site = pathlib.Path(folder).resolve()
    problems = list(link_problems(site))
    number = len(list(site.glob("*.html")))
    if not number:
        problems.append(f"{folder} has no pages")
    formulas = ""
    if browser:
        count, seen = browser_problems(site, browser)
        problems += seen
        formulas = f", {count} formulas set"
    print("\n".join(problems) if problems else f"{number} pages, no dead link{formulas}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
