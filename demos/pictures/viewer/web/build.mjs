// SPDX-License-Identifier: MIT
// node build.mjs PACKAGES PAGE OUT.html [OUT.cpp FUNCTION]: the page of the folder PAGE with styles and scripts inlined, as it
// is and as a C++ string that FUNCTION returns; and OUT.html.licences, those of the packages that are in it. PACKAGES
// holds node_modules.
import { readdir, readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [packages, web, plain] = process.argv.slice(2, 5).map((path) => resolve(path));
const [out, name] = process.argv.slice(5);
const { build } = createRequire(join(packages, "package.json"))("esbuild");

async function bundled(file, options) {
  const result = await build({
    absWorkingDir: web,
    entryPoints: [file],
    nodePaths: [join(packages, "node_modules")],
    bundle: true,
    minify: true,
    charset: "ascii",
    define: { global: "globalThis" }, // which packages for Node.js ask for
    legalComments: "eof",
    write: false,
    metafile: true,
    ...options,
  });
  return { text: result.outputFiles[0].text, inputs: result.metafile.inputs };
}

// What files named LICENSE, NOTICE and the like say, and those in folders of such names.
async function legalTexts(folder) {
  const entries = await readdir(folder, { withFileTypes: true });
  const found = entries.filter(({ name }) => /^(licen[cs]e|notice|copying)/i.test(name));
  const texts = found.map((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? legalTexts(path) : readFile(path, "utf8");
  });
  return (await Promise.all(texts)).flat();
}

async function licence(name) {
  const folder = join(packages, "node_modules", name);
  const { version, license } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
  const texts = await legalTexts(folder);
  if (texts.length === 0) throw new Error(`${name} comes without its licence`);
  return `== ${name} ${version} (${license})\n\n${texts.join("\n")}`;
}

const packageOf = (file) => file.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1];
const licences = async (files) =>
  (await Promise.all([...new Set(files.map(packageOf))].filter(Boolean).sort().map(licence))).join("\n");

const literal = (text) => `R"page(${text})page"`;

const [html, style, script] = await Promise.all([
  readFile(join(web, "index.html"), "utf8"),
  bundled("style.css", {}),
  bundled("src/main.js", { format: "iife", target: "es2022" }),
]);
const page = html.replace("/*style*/", () => style.text).replace("/*script*/", () => script.text);
if (page.includes(')page"')) throw new Error("the page has the end of its own C++ string in it");
if (/[^\x00-\x7f]/.test(page)) throw new Error("the page is to be plain ASCII");

// Compilers are only bound to take strings of 64 KiB; they join neighbours.
const pieces = page.match(/[^]{1,16000}/g).map(literal).join("\n");
await writeFile(plain, page);
await writeFile(`${plain}.licences`, await licences(Object.keys(script.inputs)));
if (out) await writeFile(
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
