// Formulas are set by KaTeX, from the site itself; buttons come from doxygen-awesome-css.
DoxygenAwesomeFragmentCopyButton.init();
DoxygenAwesomeDarkModeToggle.init();
DoxygenAwesomeParagraphLink.init();
document.addEventListener("DOMContentLoaded", () => {
  renderMathInElement(document.body, {
    delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}],
    throwOnError: false,
  });
  // A wide table or formula scrolls by itself, not the page with it.
  for (const table of document.querySelectorAll("div.textblock table.markdownTable")) {
    const frame = document.createElement("div");
    frame.className = "wide";
    table.replaceWith(frame);
    frame.append(table);
  }
});
