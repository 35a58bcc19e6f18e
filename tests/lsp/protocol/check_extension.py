"""check_extension.py FILE: whether a packed extension for VS Code has what it needs to start."""

import json
import sys
import zipfile

with zipfile.ZipFile(sys.argv[1]) as packed:
    names = set(packed.namelist())
    package = json.loads(packed.read("extension/package.json"))
    code = packed.read("extension/extension.js").decode()

contributes = package["contributes"]
needed = [package["main"], *(language["configuration"] for language in contributes["languages"]),
          *(grammar["path"] for grammar in contributes["grammars"])]
missing = [name for name in needed if "extension/" + name.removeprefix("./") not in names]
missing += [name for name in package["dependencies"] if f"extension/node_modules/{name}/package.json" not in names]
assert not missing, missing
(language,) = contributes["languages"]
assert f'language: "{language["id"]}"' in code, "the extension does not start for its language"
print(f"{len(names)} files, with all that the extension needs")
