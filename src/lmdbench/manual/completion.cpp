// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/manual/manual.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lmdbench::manual {
namespace {

constexpr const char* LICENCE =
    "# SPDX-FileCopyrightText: The lmdbench authors\n# SPDX-License-Identifier: BSD-3-Clause\n";

/// A command's options, then the program's own, which also work after the command.
std::vector<OptionText> options_behind(const CommandText& command, const CommandText& program) {
  std::vector<OptionText> options = command.options;
  if (!command.path.empty())
    for (const OptionText& option : program.options)
      if (option.names.back() != "--help" && option.names.back() != "--version") options.push_back(option);
  return options;
}

/// Quotes the characters that zsh interprets in a specification.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

std::string zsh_values(const OptionText& option) {
  if (option.values.empty()) return "_files";
  std::vector<std::string> values;
  for (const std::string& value : option.values) values.push_back(quoted(value));
  return fmt::format("({})", fmt::join(values, " "));
}

std::string zsh_argument(const OptionText& option) {
  if (option.positional)
    return fmt::format(" \\\n    '{}:{}:{}'", option.repeatable ? "*" : "", quoted(option.names.front()),
                       zsh_values(option));
  std::string text;
  for (const std::string& name : option.names) {
    text += fmt::format(" \\\n    '{}{}[{}]", option.repeatable ? "*" : "", name, quoted(option.description));
    if (!option.value.empty()) text += fmt::format(":{}:{}", quoted(option.value), zsh_values(option));
    text += "'";
  }
  return text;
}

std::string function_of(const CommandText& command) {
  std::string name = "_lmdbench";
  for (const char c : command.path.empty() ? "" : "_" + command.path) name += c == ' ' || c == '-' ? '_' : c;
  return name;
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string paths;
  std::string words;
  std::string values;
  for (const CommandText& command : commands) {
    std::vector<std::string> offered = command.subcommands;
    for (const OptionText& option : options_behind(command, commands.front())) {
      if (option.positional) continue;
      offered.insert(offered.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        values +=
            fmt::format("    '{} {}') values='{}' ;;\n", command.path, name,
                        option.values.empty() ? "FILES" : fmt::format("{}", fmt::join(option.values, " ")));
    }
    if (!command.path.empty()) paths += fmt::format("{}'{}'", paths.empty() ? "" : " | ", command.path);
    words += fmt::format("    '{}') words='{}' ;;\n", command.path, fmt::join(offered, " "));
  }
  return fmt::format(R"(# bash completion of lmdbench
{licence}_lmdbench() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD - 1]}}"
  local command='' words='' values='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "${{command:+$command }}${{COMP_WORDS[i]}}" in
      {paths}) command="${{command:+$command }}${{COMP_WORDS[i]}}" ;;
    esac
  done
  COMPREPLY=()
  case "$command $previous" in
{values}  esac
  case "$values" in
    '') ;;
    FILES)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$current")
      return
      ;;
    *)
      [[ $values == */* ]] && compopt -o nospace 2>/dev/null # JSON pointers: a value follows
      mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
      return
      ;;
  esac
  case "$command" in
{words}  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [[ -n $command && $current != -* && ${{#COMPREPLY[@]}} -eq 0 ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _lmdbench lmdbench
)",
                     fmt::arg("licence", LICENCE), fmt::arg("paths", paths), fmt::arg("values", values),
                     fmt::arg("words", words));
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  std::string text = fmt::format("#compdef lmdbench\n{}# zsh completion of lmdbench\n", LICENCE);
  for (const CommandText& command : commands) {
    std::string arguments;
    for (const OptionText& option : options_behind(command, commands.front()))
      arguments += zsh_argument(option);
    if (command.subcommands.empty()) {
      text += fmt::format("\n{}() {{\n  _arguments{}\n}}\n", function_of(command), arguments);
      continue;
    }
    std::string described;
    std::string calls;
    for (const CommandText& other : commands) {
      const std::string prefix = command.path.empty() ? "" : command.path + " ";
      if (other.path.empty() || !other.path.starts_with(prefix)) continue;
      const std::string last = other.path.substr(prefix.size());
      if (last.find(' ') != std::string::npos || other.path == command.path) continue;
      described += fmt::format("\n    '{}:{}'", last, quoted(other.description));
      calls += fmt::format("\n        {}) {} ;;", last, function_of(other));
    }
    text += fmt::format(
        "\n{0}() {{\n  local context state state_descr line\n  typeset -A opt_args\n  local -a "
        "commands=({1}\n  )\n"
        "  _arguments -C{2} \\\n    '1: :->command' \\\n    '*:: :->rest'\n  case $state in\n"
        "    command) _describe -t commands command commands ;;\n    rest)\n      case $words[1] in{3}\n     "
        " esac\n"
        "      ;;\n  esac\n}}\n",
        function_of(command), described, arguments, calls);
  }
  return text + "\n_lmdbench \"$@\"\n";
}

}  // namespace lmdbench::manual
