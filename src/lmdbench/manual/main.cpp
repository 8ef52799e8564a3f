// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// lmdbench_write_manual FOLDER: man pages and completion in FOLDER/man, FOLDER/bash, FOLDER/zsh.
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/error.h>
#include <lmdbench/cli/app.h>
#include <lmdbench/manual/manual.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush())
    throw lmdbench::EnvironmentError(file.string(), "", "cannot be written", "check the disk");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lmdbench;
  try {
    if (argc != 2) throw UsageError("", "", "names no folder", "lmdbench_write_manual FOLDER");
    const std::filesystem::path folder = argv[1];
    int exit_status = 0;
    const auto commands = manual::command_texts(*make_app({"lmdbench"}, exit_status), manual::known_values());
    for (const manual::CommandText& command : commands)
      write(folder / "man" / manual::man_page_name(command),
            manual::man_page(command, commands, build_info().version));
    write(folder / "bash" / "lmdbench", manual::bash_completion(commands));
    write(folder / "zsh" / "_lmdbench", manual::zsh_completion(commands));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
