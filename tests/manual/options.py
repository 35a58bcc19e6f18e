"""Do the pages have what --help has, no more and no less: commands, forms of the command line, options
with their words and default values, exit statuses?"""

import re
import subprocess
import sys

import pages

program = sys.argv[1]


def help_of(verb):
    command = [program, *([verb] if verb else []), "--help"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def options_in_help(verb):
    """By name, what each takes: {"-o, --output": "OUT", "--check": ""}."""
    text = re.sub(r"\[=(\w+)\]", r" \1", help_of(verb))  # a value that may be missing
    found = re.findall(r"^ +((?:-\w, ?)?--[\w-]+)(?: (\S+))?(?:  |$)", text, re.MULTILINE)
    return {re.sub(r", ?", ", ", names): value for names, value in found}


def names_and_value(item):
    """Of an item of the page, without its "Fl": ("-o, --output", "OUT")."""
    names, _, value = item.partition(" Ar ")
    may_be_missing = names.endswith(" Op")
    names = names.removesuffix(" Op").split(" , Fl ")
    return ", ".join(f"-{name}" for name in names), f"[{value}]" if may_be_missing else value


def options_in_page(verb):
    return dict(map(names_and_value, re.findall(r"^\.It Fl (.*)$", pages.page_of(verb).read_text(), re.MULTILINE)))


def paragraphs_in_page(verb):
    """By names of the option, all that the page says of it."""
    options = pages.page_of(verb).read_text().partition(".Sh EXIT STATUS")[0]
    parts = re.split(r"^\.It Fl (.*)\n", options, flags=re.MULTILINE)
    return {names_and_value(item)[0]: text for item, text in zip(parts[1::2], parts[2::2])}


def words_of(verb, option):
    """The words that completion offers as its value, if it is one of a few."""
    command = [program, "__complete", "fish", "", "3", verb, option, ""]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return {line.partition("\t")[0] for line in lines[1:]} if lines[0] == "words" else set()


def defaults_in_help(verb):
    """By the names of the option, the numbers that count without it."""
    text = re.sub(r"\s+", " ", help_of(verb))
    found = re.findall(r" ((?:-\w, ?)?--[\w-]+) (?:(?! --).)*?\(default: ([0-9.]+)\)", text)
    return {re.sub(r", ?", ", ", names): value for names, value in found}


def compare_values(verb):
    page = pages.page_of(verb).name
    paragraphs = paragraphs_in_page(verb)
    for names, value in options_in_help(verb).items():
        known = words_of(verb, names.split(", ")[-1]) if value and value.isupper() else set()
        text = paragraphs.get(names, "")
        listed = set(re.findall(r"^\.It (?:Cm|Ic) (\w+)$", text, re.MULTILINE))
        lines = re.findall(r"\b(?:Cm|Ic) (.*)$", text, re.MULTILINE)
        said = {word for line in lines for word in re.findall(r"\w+", line)}
        if value in ("FORMAT", "VIEW", "STYLE", "KIND") and not (known and known <= said):
            yield f"{page}: {names} says nothing of {', '.join(sorted(known - said))}"
        if listed and listed != known:
            yield f"{page}: {names} has the words {sorted(listed)}, the program {sorted(known)}"
    for names, number in defaults_in_help(verb).items():
        if not re.search(rf"\b{re.escape(number)}\b", paragraphs.get(names, "")):
            yield f"{page}: {names} does not say that {number} is the default"


def bad_lines_in_help(verb):
    """Lines that do not fit, and lines of the lists that are not indented."""
    text = help_of(verb)
    lists = re.findall(r"^(?:Positionals|Options|[A-Z]\w+):\n((?:.+\n)+)", text, re.MULTILINE)
    lines = [line for part in lists for line in part.splitlines() if not line.startswith("  ")]
    return lines + [line for line in text.splitlines() if len(line) > 80]


def forms_in_help(verb):
    usage = help_of(verb).partition("Usage: ")[2].partition("\n\n")[0]
    forms = [line.split(f"cbc {verb} ")[1] for line in usage.splitlines()]
    return [form.replace("[OPTION...] ", "") for form in forms]


def forms_in_page(verb):
    """Without the options that may be left out."""
    synopsis = pages.page_of(verb).read_text().partition(".Sh SYNOPSIS\n")[2].partition("\n.Sh ")[0]
    forms = []
    for line in synopsis.splitlines():
        if line == f".Nm cbc {verb}":
            forms.append([])
        elif not re.match(r"\.Op (Fl|Ar OPTION)", line):
            text = re.sub(r" ?\| ?", "|", line.replace(" ...", "..."))
            text = re.sub(r"\bFl ", "-", re.sub(r"\b(Ar|Cm) ", "", text.lstrip(".")))
            forms[-1].append(f"[{text[3:]}]" if text.startswith("Op ") else text)
    return [" ".join(form) for form in forms]


def statuses_in_help(verb):
    return set(re.findall(r"\b[0-9]\b", help_of(verb).partition("Exit status:")[2]))


def statuses_in_page(verb):
    page = pages.page_of(verb).read_text()
    return set(re.findall(r"^\.It ([0-9])$", page.partition(".Sh EXIT STATUS")[2], re.MULTILINE))


def commands_in_help():
    section = help_of("").partition("\nCommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  (\S+)", section, re.MULTILINE)


def commands_in_page():
    return re.findall(r"^\.It Cm ([a-z]+)$", pages.page_of("").read_text(), re.MULTILINE)


def schemas_of_program():
    command = [program, "schema"]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return [line.split()[0] for line in lines]


def schemas_in_page():
    section = pages.page_of("").read_text().partition(".Sh SCHEMAS\n")[2].partition("\n.Sh ")[0]
    return re.findall(r"^\.It Ic (.*)$", section, re.MULTILINE)


def compare(where, of_help, of_page):
    for name in sorted(set(of_help) | set(of_page)):
        if name not in of_page:
            yield f"{where}: {name} is in --help, but not in the page"
        elif name not in of_help:
            yield f"{where}: {name} is in the page, but not in --help"
        elif of_help[name] != of_page[name]:
            yield f"{where}: {name} takes '{of_help[name]}' in --help, '{of_page[name]}' in the page"


def options_in_text(page):
    """All that a page mentions, in whatever place."""
    return set(re.findall(r"\bFl (-?[\w-]+)", page.read_text()))


def main():
    commands = commands_in_help()
    faults = list(compare("cbc.1", dict.fromkeys(commands), dict.fromkeys(commands_in_page())))
    faults += compare("cbc.1", dict.fromkeys(schemas_of_program()), dict.fromkeys(schemas_in_page()))
    known = set()
    for verb in ("", *pages.VERBS):
        of_help = options_in_help(verb)
        if not of_help:
            faults.append(f"cbc {verb} --help: found no options in it")
        faults += compare(pages.page_of(verb).name, of_help, options_in_page(verb))
        faults += [f"cbc {verb} --help: this line: {line}" for line in bad_lines_in_help(verb)]
        if verb:
            faults += compare_values(verb)
            if forms_in_help(verb) != forms_in_page(verb):
                faults.append(
                    f"cbc {verb}: forms {forms_in_help(verb)} in --help, {forms_in_page(verb)} in the page"
                )
        if statuses_in_help(verb) != statuses_in_page(verb):
            faults.append(f"{pages.page_of(verb).name}: other exit statuses than in --help")
        known |= {name[1:] for names in of_help for name in names.split(", ")}
    for page in pages.all_pages():
        unknown = options_in_text(page) - known
        faults += [f"{page.name}: no command has the option -{name}" for name in sorted(unknown)]
    pages.finish(faults)


main()
