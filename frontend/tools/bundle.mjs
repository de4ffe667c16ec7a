/**
 * Makes of the sources what a package serves: `node tools/bundle.mjs [folder]`, from the folder of package.json.
 *
 * The folder (bundle/ if none is named) gets a `pages.json` of the same form as that of the sources, and below assets/ the
 * files that it names. Their names carry a hash of their content, so that browsers keep them for good; what compresses
 * stands there compressed, too. Each page has its own module, what pages share stands in chunks, and what is fetched
 * by import() stays apart. Libraries that come minified are taken as they are.
 */

import { createHash } from "node:crypto";
import { cp, mkdir, readdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { basename, extname, join, relative, resolve, sep } from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants, gzip } from "node:zlib";
import { build } from "esbuild";

const ROOT = process.cwd();
const PLACE = resolve(process.argv[2] ?? "bundle");
/** What is not finished does not take the place of what is. */
const FOLDER = `${PLACE}.new`;
const ASSETS = "assets";
/** Fonts are compressed in themselves, and source maps are read by developers alone. */
const COMPRESSIBLE = new Set([".js", ".mjs", ".css", ".svg"]);
const SHARED = "shared";

const site = JSON.parse(await readFile("pages.json", "utf8"));

/** Where the file of an address stands. @param {string} address */
const source = (address) => join(ROOT, ...address.split("/"));
/** The address of a file in the bundle. @param {string} output */
const served = (output) => `/${relative(FOLDER, resolve(output)).split(sep).join("/")}`;
/** @param {Buffer[]} parts */
const digest = (parts) =>
  parts
    .reduce((hash, part) => hash.update(part), createHash("sha256"))
    .digest("hex")
    .slice(0, 8);
/** Built by its authors. @param {string} address */
const finished = (address) => /\.min\.m?js$/.test(address);

/** New addresses of what was copied. @type {Map<string, Promise<string>>} */
const copies = new Map();

/** @param {string} address */
function copied(address) {
  if (!copies.has(address)) copies.set(address, address.endsWith("/") ? copiedFolder(address) : copiedFile(address));
  return /** @type {Promise<string>} */ (copies.get(address));
}

/** @param {string} address */
async function copiedFile(address) {
  const content = await readFile(source(address));
  const extension = extname(address);
  const name = `${basename(address, extension)}-${digest([content])}${extension}`;
  await writeFile(join(FOLDER, ASSETS, name), content);
  return `/${ASSETS}/${name}`;
}

/** A folder whose files keep their names, for one who asks for them by name. @param {string} address */
async function copiedFolder(address) {
  const files = (await readdir(source(address))).sort();
  const contents = await Promise.all(files.map((file) => readFile(join(source(address), file))));
  const name = `${basename(address)}-${digest(contents)}`;
  await cp(source(address), join(FOLDER, ASSETS, name), { recursive: true });
  return `/${ASSETS}/${name}/`;
}

/** Where a font of a style sheet is in the bundle: in a folder that is copied as a whole, or by itself. @param {string} address */
async function font(address) {
  const folder = Object.values(site.imports).find((one) => one.endsWith("/fonts/") && address.startsWith(one));
  return folder ? (await copied(folder)) + address.slice(folder.length) : copied(address);
}

/** The address that a module or sheet means by a name: what a browser would ask for. @param {string} name @param {string} folder */
function meant(name, folder) {
  if (name.startsWith("/")) return name;
  if (name in site.imports) return site.imports[name];
  const prefix = Object.keys(site.imports).find((one) => one.endsWith("/") && name.startsWith(one));
  if (prefix) return site.imports[prefix] + name.slice(prefix.length);
  return `/${relative(ROOT, join(folder, name)).split(sep).join("/")}`;
}

/** Names lead where the import map leads them. @type {import("esbuild").Plugin} */
const asInTheBrowser = {
  name: "as in the browser",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /.*/ }, async ({ path, kind, resolveDir }) => {
      if (kind === "entry-point") return path.startsWith("sheets:") ? { path, namespace: "sheets" } : undefined;
      const address = meant(path, resolveDir);
      if (kind === "url-token") return { path: await font(address), external: true };
      if (finished(address)) return { path, external: true };
      return { path: source(address) };
    });
    onLoad({ filter: /.*/, namespace: "sheets" }, ({ path }) => {
      const name = path.slice("sheets:".length);
      const styles = name === SHARED ? site.styles : site.pages[name].styles;
      return {
        contents: styles.map((/** @type {string} */ one) => `@import "${one}";`).join("\n"),
        loader: "css",
        resolveDir: ROOT,
      };
    });
  },
};

/** @typedef {{entryPoint?: string, imports: {path: string, kind: string}[]}} Output */

/** The module of an output and all that it begins with, itself last. @param {Record<string, Output>} outputs @param {string} entry */
function begunWith(outputs, entry) {
  const found = new Set([entry]);
  for (const output of found) {
    for (const { path, kind } of outputs[output].imports)
      if (kind === "import-statement" && path in outputs) found.add(path);
  }
  return [...found].reverse();
}

const OPTIONS = /** @type {const} */ ({
  absWorkingDir: ROOT,
  outdir: FOLDER,
  entryNames: `${ASSETS}/[name]-[hash]`,
  chunkNames: `${ASSETS}/[name]-[hash]`,
  bundle: true,
  splitting: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  minify: true,
  sourcemap: true,
  metafile: true,
  logLevel: "warning",
  plugins: [asInTheBrowser],
});

/** @param {{in: string, out: string}[]} entryPoints @param {import("esbuild").Plugin[]} further @returns {Promise<Record<string, Output>>} */
const outputsOf = async (entryPoints, ...further) =>
  (await build({ ...OPTIONS, entryPoints, plugins: [...further, asInTheBrowser] })).metafile.outputs;

/** The files that a module itself imports, but for those that it fetches later. @param {string} file */
async function importedBy(file) {
  const { metafile } = await build({ ...OPTIONS, entryPoints: [file], write: false });
  const { imports } = metafile.inputs[relative(ROOT, file).split(sep).join("/")];
  return imports
    .filter(({ kind, external }) => kind === "import-statement" && !external)
    .map(({ path }) => resolve(path));
}

/**
 * What is fetched later imports all that the page begins with, which is there by then. Else what a page begins with
 * would be cut into a chunk for each set of later parts that share it: fifteen requests instead of two.
 * @param {string[]} begun @returns {import("esbuild").Plugin}
 */
const afterTheBeginning = (begun) => ({
  name: "after the beginning",
  setup({ onResolve, onLoad }) {
    const later = new Set();
    onResolve({ filter: /^\.{1,2}\// }, ({ path, kind, resolveDir }) => {
      if (kind === "dynamic-import") later.add(join(resolveDir, path));
      return undefined;
    });
    onLoad({ filter: /\.js$/ }, async ({ path }) => {
      if (!later.has(path)) return undefined;
      const imports = begun.map((file) => `import ${JSON.stringify(`/${relative(ROOT, file).split(sep).join("/")}`)};`);
      return { contents: imports.join("") + (await readFile(path, "utf8")), loader: "js" };
    });
  },
});

/**
 * Pages one by one: what several share would else be cut into a chunk for each set of those that share it, and a page
 * would begin with thirty requests.
 */
async function bundled() {
  const pages = Object.keys(site.pages);
  const scripts = pages.map(async (name) => {
    const file = source(site.pages[name].modules.at(-1));
    return outputsOf([{ in: file, out: name }], afterTheBeginning(await importedBy(file)));
  });
  const lazy = Object.entries(site.imports).filter(([, address]) => address.endsWith(".css"));
  const sheets = outputsOf([
    ...[SHARED, ...pages].map((name) => ({ in: `sheets:${name}`, out: name })),
    ...lazy.map(([, address]) => ({ in: source(address), out: basename(address, ".css") })),
  ]);
  return /** @type {Record<string, Output>} */ (Object.assign({}, ...(await Promise.all([...scripts, sheets]))));
}

/** `pages.json` with the addresses of the bundle. @param {Record<string, Output>} outputs */
async function addressed(outputs) {
  const byEntry = new Map(Object.entries(outputs).map(([path, { entryPoint }]) => [entryPoint, path]));
  const output = (/** @type {string} */ entry) => {
    const path = byEntry.get(entry);
    if (!path) throw new Error(`the bundle has nothing of ${entry}`);
    return path;
  };
  const imports = {};
  for (const [name, address] of Object.entries(site.imports)) {
    if (address.endsWith(".css")) imports[name] = served(output(address.slice(1)));
    else if (finished(address) || address.endsWith("/fonts/")) imports[name] = await copied(address);
  }
  const pages = {};
  for (const [name, page] of Object.entries(site.pages)) {
    pages[name] = {
      description: page.description,
      styles: [served(output(`sheets:sheets:${name}`))],
      scripts: await Promise.all(page.scripts.map(copied)),
      modules: begunWith(outputs, output(page.modules.at(-1).slice(1))).map(served),
    };
  }
  const styles = [served(output(`sheets:sheets:${SHARED}`))];
  return { icon: await copied(site.icon), font: await copied(site.font), styles, imports, pages };
}

/** @param {Buffer} content */
async function forms(content) {
  const params = { [constants.BROTLI_PARAM_SIZE_HINT]: content.length };
  return Promise.all([promisify(brotliCompress)(content, { params }), promisify(gzip)(content, { level: 9 })]);
}

/** Each file that compresses, beside itself; what is there from the last time has the same name, for it has the same content. */
async function compressed() {
  const files = (await readdir(join(FOLDER, ASSETS))).filter((name) => COMPRESSIBLE.has(extname(name)));
  await Promise.all(
    files.map(async (name) => {
      const known = [".br", ".gz"].map((suffix) => readFile(join(PLACE, ASSETS, name + suffix)));
      const [brotli, gzipped] = await Promise.all(known).catch(async () =>
        forms(await readFile(join(FOLDER, ASSETS, name))),
      );
      await writeFile(join(FOLDER, ASSETS, `${name}.br`), brotli);
      await writeFile(join(FOLDER, ASSETS, `${name}.gz`), gzipped);
    }),
  );
}

/** The licences of the libraries, where they stand beside the sources. */
async function licences() {
  for (const file of await readdir("vendor", { recursive: true })) {
    if (/^LICENSE(\.txt)?$/.test(basename(file)))
      await cp(join("vendor", file), join(FOLDER, "vendor", file), { recursive: true });
  }
}

await rm(FOLDER, { recursive: true, force: true });
await mkdir(join(FOLDER, ASSETS), { recursive: true });
const outputs = await bundled();
await writeFile(join(FOLDER, "pages.json"), `${JSON.stringify(await addressed(outputs), null, 2)}\n`);
await Promise.all([
  compressed(),
  licences(),
  cp("view/frame.html", join(FOLDER, "view/frame.html")),
  cp("icon.svg", join(FOLDER, "icon.svg")),
]);
await rm(PLACE, { recursive: true, force: true });
await rename(FOLDER, PLACE);
