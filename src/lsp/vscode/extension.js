// Starts `cbc lsp` for the files of the language "behavior-catalog", and shows what it says.

const vscode = require("vscode");
const {LanguageClient} = require("vscode-languageclient/node");

let client;

function activate(context) {
  const program = vscode.workspace.getConfiguration("cbc").get("program") || "cbc";
  client = new LanguageClient(
    "cbc", "Behavior catalogs", {command: program, args: ["lsp"]},
    {documentSelector: [{language: "behavior-catalog"}]});
  context.subscriptions.push({dispose: () => client.stop()});
  return client.start();
}

module.exports = {activate, deactivate: () => client && client.stop()};
