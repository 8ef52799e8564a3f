// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/manual/manual.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lmdbench::manual {
namespace {

std::string replaced(const std::string& text, char from, const std::string& to) {
  std::string result;
  for (const char c : text) result += c == from ? to : std::string(1, c);
  return result;
}

/// Text that roff shows unchanged.
std::string escaped(const std::string& text) {
  std::string line_begin = replaced(replaced(text, '\\', "\\e"), '-', "\\-");
  std::string result;
  for (std::size_t i = 0; i < line_begin.size(); ++i) {
    const bool begins = i == 0 || line_begin[i - 1] == '\n';
    if (begins && (line_begin[i] == '.' || line_begin[i] == '\'')) result += "\\&";  // no request
    result += line_begin[i];
  }
  return result;
}

/// Keeps the text's lines.
std::string lines(const std::string& text) {
  return replaced(escaped(text), '\n', "\n.br\n") + "\n";
}

std::string title(const CommandText& command) {
  return command.path.empty() ? "lmdbench" : "lmdbench-" + replaced(command.path, ' ', "-");
}

std::string synopsis(const CommandText& command) {
  std::string text = fmt::format(".B lmdbench{}\n", command.path.empty() ? "" : " " + escaped(command.path));
  for (const OptionText& option : command.options) {
    if (option.positional)
      text += fmt::format("{}\\fI{}\\fR{}{}\n", option.required ? "" : "[", escaped(option.names.front()),
                          option.repeatable ? " ..." : "", option.required ? "" : "]");
    else if (option.required)
      text += fmt::format("\\fB{}\\fR \\fI{}\\fR\n", escaped(option.names.back()), escaped(option.value));
  }
  return text + (command.subcommands.empty() ? "[\\fIOPTIONS\\fR]\n" : "\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n");
}

std::string option_entry(const OptionText& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names)
    names.push_back(fmt::format("\\f{}{}\\fR", option.positional ? 'I' : 'B', escaped(name)));
  std::string text = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (!option.positional && !option.value.empty()) text += fmt::format(" \\fI{}\\fR", escaped(option.value));
  text += "\n" + lines(option.description);
  if (!option.usual.empty()) text += fmt::format(".br\nWithout it: {}\n", escaped(option.usual));
  if (option.required && !option.positional) text += ".br\nRequired.\n";
  return text;
}

/// For "name:" with options below it: as typed in --help.
std::string as_typed(const std::string& text) {
  return fmt::format(".nf\n{}\n.fi\n", escaped(text));
}

}  // namespace

std::string man_page_name(const CommandText& command) {
  return title(command) + ".1";
}

std::string man_page(const CommandText& command, const std::vector<CommandText>& all,
                     const std::string& version) {
  std::string name = title(command);
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = fmt::format(".TH {} 1 \"\" \"lmdbench {}\" \"lmdbench\"\n", escaped(upper), version);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", escaped(name), escaped(command.description),
                      synopsis(command));
  if (!command.subcommands.empty()) {
    text += ".SH COMMANDS\n";
    for (const CommandText& other : all) {
      const std::size_t space = other.path.rfind(' ');
      const std::string parent = space == std::string::npos ? "" : other.path.substr(0, space);
      if (other.path.empty() || parent != command.path) continue;
      text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(other.path), escaped(other.description));
    }
  }
  text += ".SH OPTIONS\n";
  for (const OptionText& option : command.options) text += option_entry(option);
  if (!command.path.empty()) text += ".PP\nThose of every command (limits, talk) are in\n.BR lmdbench (1).\n";
  if (!command.footer.empty()) text += ".SH NOTES\n" + as_typed(command.footer);
  text +=
      ".SH EXIT STATUS\n0 done; 1 a check failed; 2 usage or experiment file wrong; 3 input data wrong; 4 "
      "the "
      "environment lacks something; 70 a bug of lmdbench.\n";
  if (command.path.empty()) {
    text +=
        ".SH ENVIRONMENT\n.TP\n\\fBNO_COLOR\\fR\nNo colours on terminals.\n.TP\n\\fBLMDBENCH_SCRIPTS\\fR\n"
        "Folder of the scripts that \\fBlmdbench report\\fR runs, in place of the installed ones.\n";
    return text;
  }
  return text + ".SH SEE ALSO\n.BR lmdbench (1)\n";
}

}  // namespace lmdbench::manual
