// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/number_lines.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace lmdbench {

void for_each_number_line(
    const std::string& text, const std::string& name, const std::string& remedy,
    const std::function<void(const std::string& place, std::span<const double> numbers)>& use) {
  std::istringstream lines(text);
  std::vector<double> numbers;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string place = fmt::format("line {}", ++number);
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    numbers.clear();
    for (std::string word; words >> word;) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0' || !std::isfinite(value))
        throw InputError(name, place, fmt::format("\"{}\" is no finite number", word), remedy);
      numbers.push_back(value);
    }
    if (!numbers.empty()) use(place, numbers);
  }
}

}  // namespace lmdbench
