// Sets what Sphinx marks as an equation, with KaTeX (which build.py puts in front of this).
document.addEventListener("DOMContentLoaded", () => {
  for (const place of document.querySelectorAll(".math.notranslate")) {
    const text = place.textContent.trim();
    const inline = text.startsWith("\\(");
    katex.render(text.replace(/^\\[([]|\\[)\]]$/g, ""), place, { displayMode: !inline, throwOnError: false });
  }
});
