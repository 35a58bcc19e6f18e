// check_types.js FILE: checks what a server has said, one [METHOD, MESSAGE] in JSON on each line of FILE, against the
// types of the protocol: each result becomes a constant of its type, and the TypeScript compiler says what does not fit.

const fs = require("fs");
const path = require("path");
const ts = require("typescript");

// What is asked for, or told: the type of the result, or of the parameters.
const results = {
  "initialize": "InitializeResult",
  "shutdown": "null",
  "textDocument/codeAction": "(Command | CodeAction)[] | null",
  "textDocument/codeLens": "CodeLens[] | null",
  "textDocument/completion": "CompletionItem[] | CompletionList | null",
  "textDocument/definition": "Definition | null",
  "textDocument/documentHighlight": "DocumentHighlight[] | null",
  "textDocument/documentSymbol": "DocumentSymbol[] | SymbolInformation[] | null",
  "textDocument/foldingRange": "FoldingRange[] | null",
  "textDocument/hover": "Hover | null",
  "textDocument/inlayHint": "InlayHint[] | null",
  "textDocument/prepareRename": "PrepareRenameResult | null",
  "textDocument/references": "Location[] | null",
  "textDocument/rename": "WorkspaceEdit | null",
  "workspace/executeCommand": "LSPAny",
};
const params = {
  "client/registerCapability": "RegistrationParams",
  "textDocument/publishDiagnostics": "PublishDiagnosticsParams",
  "window/logMessage": "LogMessageParams",
  "window/showMessage": "ShowMessageParams",
  "workspace/codeLens/refresh": "undefined",
  "workspace/inlayHint/refresh": "undefined",
};
const own = new Set(["cbc/isIdle", "no/such"]); // of the tests

const said = new Map(); // type: texts
let count = 0;
for (const line of fs.readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  const [method, message] = JSON.parse(line);
  const isTold = "method" in message;
  let type = isTold ? params[method] : results[method];
  let value = isTold ? message.params : message.result;
  if ("error" in message) {
    type = "ResponseErrorLiteral";
    value = message.error;
  } else if (own.has(method)) {
    continue;
  }
  if (type === undefined) throw new Error(`no type is known for ${method}`);
  if (!said.has(type)) said.set(type, new Set());
  said.get(type).add(value === undefined ? "undefined" : JSON.stringify(value));
  ++count;
}

const missing = [...Object.values(results), ...Object.values(params)].filter(type => !said.has(type));
if (missing.length) throw new Error(`nothing was said of type ${missing.join("; ")}`);

let text = 'import * as p from "vscode-languageserver-protocol";\n' +
           "type ResponseErrorLiteral = {code: number, message: string};\n";
let number = 0;
for (const [type, values] of said) {
  const known = type.replace(/\b[A-Z]\w+/g, name => name === "ResponseErrorLiteral" ? name : "p." + name);
  for (const value of values) text += `const said${++number}: ${known} = ${value};\n`;
}
// One that must not fit, so that this can fail.
text += 'const wrong: p.Hover = {"contents": 5};\n';

const file = path.join(__dirname, "said.ts");
fs.writeFileSync(file, text);
const program = ts.createProgram([file], {
  noEmit: true, strict: true, skipLibCheck: true, types: [], target: ts.ScriptTarget.ES2022,
  module: ts.ModuleKind.CommonJS, moduleResolution: ts.ModuleResolutionKind.Node10});
const lines = text.split("\n");
const faults = ts.getPreEmitDiagnostics(program).map(fault => {
  const line = fault.file ? fault.file.getLineAndCharacterOfPosition(fault.start).line : 0;
  return {line: lines[line], message: ts.flattenDiagnosticMessageText(fault.messageText, "\n")};
});
const unexpected = faults.filter(fault => !fault.line.startsWith("const wrong"));
for (const fault of unexpected.slice(0, 20)) console.log(`${fault.line.slice(0, 300)}\n${fault.message}\n`);
if (faults.length === unexpected.length) unexpected.push("nothing was found in what is wrong");
console.log(`${count} messages, ${number} different ones, ${unexpected.length} do not fit the protocol`);
process.exit(unexpected.length ? 1 : 0);
