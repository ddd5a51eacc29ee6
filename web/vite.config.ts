// One file in the end: page, style, workers and engine, so that it opens from a disk as well as from any host.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

/** `?packed`: a file's bytes, compressed, as text in base64. Hosts compress what they send, but not through base64. */
function packed(): Plugin {
  return {
    name: "packed",
    enforce: "pre",
    load(id) {
      const [path, query] = id.split("?");
      if (query !== "packed") return null;
      this.addWatchFile(path!);
      const text = gzipSync(readFileSync(path!), { level: 9 }).toString("base64");
      return { code: `export default ${JSON.stringify(text)};`, moduleType: "js" };
    },
  };
}

/** The licences of what others wrote and the page carries. */
function notices(): string {
  const folder = new URL("../packaging/notices/", import.meta.url);
  const text = ["explorer.txt", "mit.txt", "random123.txt"].map((name) => readFileSync(new URL(name, folder), "utf8"));
  return `<!--\n${text.join("\n")}-->`;
}

/** What the page may do: run these scripts, in its workers too, and compile the engine; fetch nothing from anywhere. */
function policy(scripts: readonly string[]): string {
  const hashes = scripts.map((text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`).join(" ");
  const rules = [
    "default-src 'none'",
    `script-src ${hashes} 'wasm-unsafe-eval'`,
    "worker-src blob: data:",
    "style-src 'unsafe-inline'",
    "img-src data: blob:",
    "base-uri 'none'",
    "form-action 'none'",
  ];
  return `<meta http-equiv="Content-Security-Policy" content="${rules.join("; ")}" />`;
}

/** Scripts and style sheets written into the page that asks for them. */
function singleFile(): Plugin {
  return {
    name: "single-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") return;
      let html = String(page.source);
      const scripts: string[] = [];
      for (const [name, part] of Object.entries(bundle)) {
        if (name === "index.html") continue;
        const text = part.type === "chunk" ? part.code : String(part.source);
        const script = new RegExp(`<script[^>]*src="[./]*${name}"[^>]*></script>`);
        const style = new RegExp(`<link[^>]*href="[./]*${name}"[^>]*>`);
        if (script.test(html)) {
          // At the end of the body, and with nothing in it that would end a script.
          scripts.push(text.replaceAll("</script", "<\\/script"));
          const inline = `<script type="module">${scripts.at(-1)}</script>`;
          html = html.replace(script, "").replace("</body>", () => `${inline}\n  </body>`);
        } else if (style.test(html)) html = html.replace(style, () => `<style>${text}</style>`);
        else this.error(`${name} is asked for by nobody`);
        delete bundle[name];
      }
      html = html.replace('<meta charset="utf-8" />', (charset) => `${charset}\n    ${policy(scripts)}`);
      page.source = html.replace("</html>", () => `</html>\n${notices()}`);
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [packed(), singleFile()],
  worker: { plugins: () => [packed()] },
  build: {
    outDir: process.env.EQUIPOISE_WEB_OUT ?? fileURLToPath(new URL("../build/web", import.meta.url)),
    emptyOutDir: false,
    target: "es2022",
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 100_000_000,
  },
});
