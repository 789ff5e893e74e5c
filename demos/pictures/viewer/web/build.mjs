// SPDX-License-Identifier: MIT
// node build.mjs PACKAGES PAGE OUT.html OUT.cpp FUNCTION: the page of the folder PAGE with styles and scripts inlined, as it
// is and as a C++ string that FUNCTION returns. PACKAGES holds node_modules.
import { readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [packages, web, plain, out] = process.argv.slice(2, 6).map((path) => resolve(path));
const name = process.argv[6];
const { build } = createRequire(join(packages, "package.json"))("esbuild");

async function bundled(file, options) {
  const result = await build({
    absWorkingDir: web,
    entryPoints: [file],
    nodePaths: [join(packages, "node_modules")],
    bundle: true,
    minify: true,
    charset: "ascii",
    legalComments: "eof",
    write: false,
    ...options,
  });
  return result.outputFiles[0].text;
}

const literal = (text) => `R"page(${text})page"`;

const [html, style, script] = await Promise.all([
  readFile(join(web, "index.html"), "utf8"),
  bundled("style.css", {}),
  bundled("src/main.js", { format: "iife", target: "es2022" }),
]);
const page = html.replace("/*style*/", () => style).replace("/*script*/", () => script);
if (page.includes(')page"')) throw new Error("the page has the end of its own C++ string in it");
if (/[^\x00-\x7f]/.test(page)) throw new Error("the page is to be plain ASCII");

// Compilers are only bound to take strings of 64 KiB; they join neighbours.
const pieces = page.match(/[^]{1,16000}/g).map(literal).join("\n");
await writeFile(plain, page);
await writeFile(
  out,
  `// Made by build.mjs.
#include "pictures/viewer/shell.hpp"

namespace boxstream::view {

std::string_view ${name}() {
  static constexpr char text[] =
${pieces};
  return {text, sizeof text - 1};
}

}  // namespace boxstream::view
`,
);
