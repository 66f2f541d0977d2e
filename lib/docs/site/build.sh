#!/bin/sh
# build.sh EXPERIMENTS: the site in build/docs/html, from the table of experiments that CMake writes; run from the top folder.
# Everything that a page loads lies inside of it: it works from any server and from a disk.
set -eu
here=lib/docs/site pages=build/docs/pages html=build/docs/html
katex=/usr/share/javascript/katex
mkdir -p build/docs build/figures
rm -rf build/docs/gallery "$html"
lib/docs/gallery.sh "$1" build/docs/gallery
python3 "$here/pages.py" lib/docs "$pages" build/docs/gallery/*.md
doxygen lib/Doxyfile
mkdir -p "$html/katex"
cp -L "$katex/katex.min.css" "$katex/katex.js" "$katex/contrib/auto-render.js" "$html/katex"
cp -rL "$katex/fonts" "$html/katex"
rm -f "$html"/katex/fonts/*.woff "$html"/katex/fonts/*.ttf  # every browser of today reads woff2
