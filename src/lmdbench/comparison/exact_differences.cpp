// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/exact_differences.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

std::size_t rows_of(const ResultReader& file, const std::string& path) {
  if (!file.has(path)) return 0;
  const std::vector<std::size_t> shape = file.shape(path);
  return shape.empty() ? 0 : shape.front();
}

std::optional<std::int64_t> entry(const ResultReader& file, const std::string& path, std::size_t row) {
  const std::vector<std::int64_t> frames = file.integers(path);
  if (row >= frames.size()) return std::nullopt;
  return frames[row];
}

}  // namespace

std::optional<std::int64_t> frame_of_row(const ResultReader& file, const std::string& group,
                                         const std::string& dataset, std::size_t row) {
  const std::string path = group + "/" + dataset;
  const std::string own_group = path.substr(0, path.rfind('/'));
  const std::string name = path.substr(own_group.size() + 1);
  if (own_group.ends_with("/summary")) return std::nullopt;
  const auto list_of = [&](const char* offsets_name, std::size_t item) {
    const std::vector<std::int64_t> offsets = file.integers(own_group + "/" + offsets_name);
    const auto after = std::ranges::upper_bound(offsets, static_cast<std::int64_t>(item));
    return static_cast<std::size_t>(after - offsets.begin()) - 1;
  };
  const bool names_frames = file.has(own_group + "/frame");
  if (file.has(own_group + "/frame_offset") && name != "frame") {
    std::size_t at = row;  // Of a line or point, then of its frame's list.
    if (name.ends_with("_offset")) at = row > 0 ? row - 1 : 0;  // i + 1 closes i
    if (name == "point") at = list_of("point_offset", at);
    if (name != "frame_offset") at = list_of("frame_offset", at);
    return names_frames ? entry(file, own_group + "/frame", at) : static_cast<std::int64_t>(at);
  }
  if (names_frames) return entry(file, own_group + "/frame", row);
  const std::size_t rows = rows_of(file, path);
  if (rows == rows_of(file, "/path/time")) return static_cast<std::int64_t>(row);
  if (rows == rows_of(file, group + "/global_frame")) return entry(file, group + "/global_frame", row);
  return std::nullopt;
}

namespace {

constexpr const char* ABSENT_HERE = "absent";
constexpr const char* PRESENT_HERE = "present";

/// Times differ between runs. Samples are marked by their name, numbers of the summary by an
/// attribute (results/README.md), which files of earlier versions lack.
bool is_time(const ResultReader& file, const std::string& group, const std::string& name) {
  if (name.ends_with("_time")) return true;
  const std::string path = group + "/" + name;
  return file.integer_attribute(path, "made_of_times") == 1 ||
         (group.ends_with("/summary") && file.text_attribute(path, "units") == "s");
}

bool is_counter_group(const std::string& name) {
  return name == "counters" || name == "global_counters";
}

/// Paths in a group, to any depth, of everything that has the same bits in every run.
void collect_deterministic(const ResultReader& file, const std::string& group, const std::string& prefix,
                           std::vector<std::string>& paths) {
  for (const std::string& name : file.datasets(group))
    if (!is_time(file, group, name)) paths.push_back(prefix + name);
  for (const std::string& name : file.groups(group))
    collect_deterministic(file, fmt::format("{}/{}", group, name), fmt::format("{}{}/", prefix, name), paths);
}

std::vector<std::string> deterministic_datasets(const ResultReader& file, const std::string& group) {
  std::vector<std::string> paths;
  collect_deterministic(file, group, "", paths);
  return paths;
}

bool allowed(const std::string& dataset, const ExactOptions& options) {
  const std::size_t slash = dataset.find('/');
  if (slash == std::string::npos || !is_counter_group(dataset.substr(0, slash))) return false;
  const auto& names = options.allowed_counters;
  return std::find(names.begin(), names.end(), dataset.substr(slash + 1)) != names.end();
}

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Equality of rows of `width` values from `first` on.
struct RowsEqual {
  double tolerance;

  bool operator()(const std::vector<double>& a, const std::vector<double>& b, std::size_t first,
                  std::size_t width) const {
    double largest = 0.0;
    for (std::size_t i = first; i < first + width; ++i)
      if (std::isfinite(a[i]) && std::isfinite(b[i]))
        largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
    for (std::size_t i = first; i < first + width; ++i)
      if (!same_bits(a[i], b[i]) && !(std::abs(a[i] - b[i]) <= tolerance * largest && tolerance > 0.0))
        return false;
    return true;
  }
  template <typename Value>
  bool operator()(const std::vector<Value>& a, const std::vector<Value>& b, std::size_t first,
                  std::size_t width) const {
    return std::equal(a.begin() + static_cast<std::ptrdiff_t>(first),
                      a.begin() + static_cast<std::ptrdiff_t>(first + width),
                      b.begin() + static_cast<std::ptrdiff_t>(first));
  }
};

template <typename Value>
nlohmann::json row_value(const std::vector<Value>& values, std::size_t first, std::size_t width,
                         bool scalar) {
  if (scalar) return values[first];
  return std::vector<Value>(values.begin() + static_cast<std::ptrdiff_t>(first),
                            values.begin() + static_cast<std::ptrdiff_t>(first + width));
}

/// Both sides of one dataset.
class DatasetPair {
 public:
  DatasetPair(const ResultReader& base, const ResultReader& candidate, std::string method, std::string group,
              std::string dataset)
      : base_(base),
        candidate_(candidate),
        method_(std::move(method)),
        group_(std::move(group)),
        dataset_(std::move(dataset)),
        path_(group_ + "/" + dataset_) {}

  std::optional<Difference> compare(const ExactOptions& options) const {
    if (!candidate_.has(path_)) {
      if (counts_nothing()) return std::nullopt;
      return whole(PRESENT_HERE, ABSENT_HERE);
    }
    const std::vector<std::size_t> shape = base_.shape(path_), other = candidate_.shape(path_);
    const bool same_rows =
        shape.size() == other.size() &&
        std::equal(shape.begin() + !shape.empty(), shape.end(), other.begin() + !other.empty());
    if (!same_rows || base_.kind(path_) != candidate_.kind(path_)) return whole(shape, other);
    switch (base_.kind(path_)) {
      case ElementKind::REAL:
        return compare_rows(base_.reals(path_), candidate_.reals(path_), shape, other, options);
      case ElementKind::INTEGER:
        return compare_rows(base_.integers(path_), candidate_.integers(path_), shape, other, options);
      case ElementKind::TEXT:
        break;
    }
    return compare_rows(base_.texts(path_), candidate_.texts(path_), shape, other, options);
  }

 private:
  Difference whole(nlohmann::json base, nlohmann::json candidate) const {
    return {method_, name(), std::nullopt, std::move(base), std::move(candidate), 0};
  }
  std::string name() const { return method_.empty() ? path_ : dataset_; }

  template <typename Value>
  std::optional<Difference> compare_rows(const std::vector<Value>& base, const std::vector<Value>& candidate,
                                         const std::vector<std::size_t>& shape,
                                         const std::vector<std::size_t>& other,
                                         const ExactOptions& options) const {
    const std::size_t rows = shape.empty() ? 1 : shape.front(),
                      other_rows = other.empty() ? 1 : other.front();
    const std::size_t width =
        std::accumulate(shape.begin() + !shape.empty(), shape.end(), std::size_t{1}, std::multiplies<>());
    const std::size_t comparable = comparable_rows(std::min(rows, other_rows));
    const RowsEqual equal{options.tolerance_relative};
    std::optional<Difference> difference;
    for (std::size_t row = 0; row < comparable; ++row) {
      if (equal(base, candidate, row * width, width)) continue;
      if (!difference)
        difference = Difference{method_,
                                name(),
                                frame_of_row(base_, group_, dataset_, row),
                                row_value(base, row * width, width, shape.size() <= 1),
                                row_value(candidate, row * width, width, shape.size() <= 1),
                                0};
      ++difference->rows;
    }
    const bool cut_by_offsets = comparable < std::min(rows, other_rows);
    if (!difference && rows != other_rows && !cut_by_offsets && !ragged()) return whole(shape, other);
    return difference;
  }

  /// A counter that was 0 on the whole path: a method that no longer writes it lost nothing.
  bool counts_nothing() const {
    if (!is_counter_group(dataset_.substr(0, dataset_.find('/')))) return false;
    const std::vector<std::int64_t> values = base_.integers(path_);
    return std::all_of(values.begin(), values.end(), [](std::int64_t value) { return value == 0; });
  }

  bool ragged() const {
    const std::string own_group = path_.substr(0, path_.rfind('/'));
    return base_.has(own_group + "/frame_offset") && candidate_.has(own_group + "/frame_offset") &&
           !path_.ends_with("/frame_offset");
  }

  /// Rows of ragged lists correspond only up to the first frame whose number of entries differs;
  /// `frame_offset` reports that frame, `point_offset` the first polyline with other points.
  std::size_t comparable_rows(std::size_t rows) const {
    if (!ragged()) return rows;
    const std::string own_group = path_.substr(0, path_.rfind('/'));
    const std::string name = path_.substr(own_group.size() + 1);
    if (name == "frame") return rows;
    const std::string offsets = own_group + (name == "point" ? "/point_offset" : "/frame_offset");
    const std::vector<std::int64_t> a = base_.integers(offsets), b = candidate_.integers(offsets);
    const auto differs = std::ranges::mismatch(a, b).in1;
    if (differs == a.begin() || (differs == a.end() && a.size() == b.size())) return rows;
    const std::size_t ends = name == "point_offset" ? 1 : 0;
    return std::min(rows, static_cast<std::size_t>(*std::prev(differs)) + ends);
  }

  const ResultReader& base_;
  const ResultReader& candidate_;
  std::string method_;
  std::string group_;
  std::string dataset_;
  std::string path_;
};

/// Numbers of the frames in which the true force is known (MethodSummary): all, or the probed ones.
bool is_of_true_steps(const std::string& dataset) {
  return dataset.starts_with("summary/force_jump_") || dataset.starts_with("summary/true_");
}

/// Whether the run was asked not to keep a dataset of a method.
bool left_out(const ResultReader& file, const std::string& dataset) {
  constexpr const char* EXPERIMENT = "/provenance/experiment";
  const char* kind = dataset.starts_with("lmds/")                             ? "lmds"
                     : dataset.ends_with("torque")                            ? "torque"
                     : is_counter_group(dataset.substr(0, dataset.find('/'))) ? "counters"
                                                                              : nullptr;
  if (kind == nullptr || !file.has(EXPERIMENT)) return false;
  const nlohmann::json experiment = nlohmann::json::parse(file.texts(EXPERIMENT).front(), nullptr, false);
  const nlohmann::json::json_pointer place = nlohmann::json::json_pointer("/record") / kind;
  return experiment.contains(place) && experiment[place] == false;
}

void compare_group(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                   const std::string& group, const ExactOptions& options,
                   std::vector<Difference>& differences) {
  const bool same_steps = same_true_steps(base, candidate);
  for (const std::string& dataset : deterministic_datasets(base, group)) {
    if (allowed(dataset, options) || is_time(candidate, group, dataset)) continue;
    if (!same_steps && is_of_true_steps(dataset)) continue;
    if (!candidate.has(fmt::format("{}/{}", group, dataset)) && left_out(candidate, dataset)) continue;
    if (auto difference = DatasetPair(base, candidate, method, group, dataset).compare(options))
      differences.push_back(std::move(*difference));
  }
}

/// The hash also covers features of LMDs that no list of the file holds. Not used with a tolerance.
void compare_hash(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                  std::vector<Difference>& differences) {
  const std::string group = "/methods/" + method;
  const auto a = base.text_attribute(group, "result_hash"),
             b = candidate.text_attribute(group, "result_hash");
  if (a == b) return;
  const auto shown = [](const std::optional<std::string>& hash) {
    return nlohmann::json(hash.value_or(ABSENT_HERE));
  };
  differences.push_back({method, "result_hash", std::nullopt, shown(a), shown(b), 0});
}

}  // namespace

bool same_true_steps(const ResultReader& base, const ResultReader& candidate) {
  const auto of_every_frame = [](const ResultReader& file) {
    return !file.text_attribute("/summary", "truth_of_every_frame").value_or("").empty();
  };
  return of_every_frame(base) == of_every_frame(candidate);
}

std::vector<Difference> exact_differences(const ResultReader& base, const ResultReader& candidate,
                                          const ExactOptions& options) {
  std::vector<Difference> differences;
  for (const std::string& method : base.groups("/methods")) {
    const std::string group = "/methods/" + method;
    if (!candidate.has(group)) {
      differences.push_back({method, "", std::nullopt, PRESENT_HERE, ABSENT_HERE, 0});
      continue;
    }
    std::vector<Difference> of_method;
    compare_group(base, candidate, method, group, options, of_method);
    const bool explained = std::any_of(of_method.begin(), of_method.end(), [](const Difference& d) {
      return !is_counter_group(d.dataset.substr(0, d.dataset.find('/')));
    });
    if (!explained && options.tolerance_relative == 0.0) compare_hash(base, candidate, method, of_method);
    std::move(of_method.begin(), of_method.end(), std::back_inserter(differences));
  }
  if (base.has("/reference") && candidate.has("/reference"))
    compare_group(base, candidate, "", "/reference", options, differences);
  std::sort(differences.begin(), differences.end(), reported_before);
  return differences;
}

std::vector<Difference> group_differences(const ResultReader& base, const ResultReader& candidate,
                                          const std::string& group) {
  std::vector<Difference> differences;
  compare_group(base, candidate, "", group, {}, differences);
  return differences;
}

std::vector<std::string> additions(const ResultReader& base, const ResultReader& candidate) {
  std::vector<std::string> names;
  for (const std::string& method : candidate.groups("/methods")) {
    const std::string group = "/methods/" + method;
    if (!base.has(group)) {
      names.push_back("method " + method);
      continue;
    }
    for (const std::string& dataset : deterministic_datasets(candidate, group))
      if (!base.has(fmt::format("{}/{}", group, dataset)))
        names.push_back(fmt::format("{}/{}", method, dataset));
  }
  return names;
}

std::vector<std::string> counters_of(const ResultReader& file) {
  std::set<std::string> names;
  for (const std::string& method : file.groups("/methods"))
    for (const char* group : {"/counters", "/global_counters"})
      for (const std::string& name : file.datasets("/methods/" + method + group)) names.insert(name);
  return {names.begin(), names.end()};
}

}  // namespace lmdbench
