"""Do the pages have the options, exit statuses and commands of --help, no more and no less?"""

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
    found = re.findall(r"^ +((?:-\w, ?)?--[\w-]+)(?: (\S+))?(?:  |$)", help_of(verb), re.MULTILINE)
    return {re.sub(r", ?", ", ", names): value for names, value in found}


def options_in_page(verb):
    found = {}
    for item in re.findall(r"^\.It Fl (.*)$", pages.page_of(verb).read_text(), re.MULTILINE):
        names, _, value = item.partition(" Ar ")
        found[", ".join(f"-{name}" for name in names.split(" , Fl "))] = value
    return found


def statuses_in_help(verb):
    return set(re.findall(r"\b[0-9]\b", help_of(verb).partition("Exit status:")[2]))


def statuses_in_page(verb):
    page = pages.page_of(verb).read_text()
    return set(re.findall(r"^\.It ([0-9])$", page.partition(".Sh EXIT STATUS")[2], re.MULTILINE))


def commands_in_help():
    section = help_of("").partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  (\S+)", section, re.MULTILINE)


def commands_in_page():
    return re.findall(r"^\.It Cm ([a-z]+)$", pages.page_of("").read_text(), re.MULTILINE)


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
    known = set()
    for verb in ("", *pages.VERBS):
        of_help = options_in_help(verb)
        if len(of_help) < 2:
            faults.append(f"cbc {verb} --help: found no options in it")
        faults += compare(pages.page_of(verb).name, of_help, options_in_page(verb))
        if statuses_in_help(verb) != statuses_in_page(verb):
            faults.append(f"{pages.page_of(verb).name}: other exit statuses than in --help")
        known |= {name[1:] for names in of_help for name in names.split(", ")}
    for page in pages.all_pages():
        unknown = options_in_text(page) - known
        faults += [f"{page.name}: no command has the option -{name}" for name in sorted(unknown)]
    pages.finish(faults)


main()
