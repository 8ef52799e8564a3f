// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/exact_differences.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <span>
#include <string_view>
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
  if (own_group == group && group.starts_with("/scene/")) return std::nullopt;  // a row an instance
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
  const std::string outer = own_group.substr(0, own_group.rfind('/'));  // of movers/
  if (own_group.size() > group.size() && file.has(outer + "/frame"))
    return entry(file, outer + "/frame", row);
  const std::size_t rows = rows_of(file, path);
  if (rows == rows_of(file, "/path/time")) return static_cast<std::int64_t>(row);
  if (rows == rows_of(file, group + "/global_frame")) return entry(file, group + "/global_frame", row);
  return std::nullopt;
}

namespace {

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

struct RowsEqual {
  double tolerance;

  bool operator()(std::span<const double> a, std::span<const double> b) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (std::isfinite(a[i]) && std::isfinite(b[i]))
        largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same_bits(a[i], b[i]) && !(std::abs(a[i] - b[i]) <= tolerance * largest && tolerance > 0.0))
        return false;
    return true;
  }
  template <typename Value>
  bool operator()(std::span<const Value> a, std::span<const Value> b) const {
    return std::ranges::equal(a, b);
  }
};

template <typename Value>
nlohmann::json row_value(std::span<const Value> row, bool scalar) {
  if (scalar) return row.front();
  return std::vector<Value>(row.begin(), row.end());
}

/// Null where the experiment has none.
nlohmann::json setting(const nlohmann::json& experiment, const std::string& pointer) {
  const nlohmann::json::json_pointer place(pointer);
  return experiment.is_object() && experiment.contains(place) ? experiment[place] : nlohmann::json();
}

/// Numbers of the frames in which the true force is known (MethodSummary): all, or the probed ones.
bool is_of_true_steps(const std::string& dataset) {
  return dataset.starts_with("summary/force_jump_") || dataset.starts_with("summary/true_jump") ||
         dataset.starts_with("summary/true_force_jump_");
}

/// Numbers of a summary that are of the probed frames.
bool is_of_probed_frames(const std::string& dataset) {
  constexpr std::string_view NAMES[] = {
      "frames_probed", "frames_wrong", "recall",      "precision", "minimum_distance_error",
      "force_error",   "force_angle",  "force_jump_", "true_"};
  constexpr std::string_view SUMMARY = "summary/";
  return dataset.starts_with(SUMMARY) && std::ranges::any_of(NAMES, [&](std::string_view name) {
           return std::string_view(dataset).substr(SUMMARY.size()).starts_with(name);
         });
}

/// The experiment's key that decides whether a dataset is kept, and of which frames; "" for none.
/// @param dataset inside a method's group, or "reference/frame" of the root
std::string deciding_key(const std::string& dataset, bool of_method) {
  if (dataset.starts_with("truth/") || dataset.starts_with("reference/") || is_of_probed_frames(dataset))
    return "/probes/truth/stride_frames";
  if (dataset.starts_with("fcl/") || dataset.starts_with("crosscheck/")) return "/probes/fcl/stride_frames";
  if (dataset.starts_with("polylines/")) return "/record/polylines/stride_frames";
  if (!of_method || dataset.starts_with("summary/")) return "";
  if (dataset.starts_with("lmds/")) return "/record/lmds";
  if (dataset.ends_with("torque")) return "/record/torque";
  return is_counter_group(dataset.substr(0, dataset.find('/'))) ? "/record/counters" : "/record/frames";
}

/// Whether the run was asked not to keep what a key decides.
bool left_out(const nlohmann::json& experiment, const std::string& key) {
  if (key.empty()) return false;
  const nlohmann::json value = setting(experiment, key);
  return value.is_boolean() ? !value.get<bool>() : value == 0;
}

/// "frame" of a table, or the frames of searches.
bool is_frame_list(const std::string& dataset) {
  return dataset == "global_frame" || dataset == "frame" || dataset.ends_with("/frame");
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

  /// @param other_frames whether the experiments ask for rows of other frames
  std::optional<Difference> compare(const ExactOptions& options, bool other_frames) const {
    if (!candidate_.has(path_)) {
      if (counts_nothing()) return std::nullopt;
      return whole(PRESENT, ABSENT);
    }
    if (is_frame_list(dataset_)) return compare_frames(other_frames);
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

  /// The first frame that one side alone has.
  std::optional<Difference> compare_frames(bool other_frames) const {
    std::vector<std::int64_t> base = base_.integers(path_), candidate = candidate_.integers(path_), alone;
    if (base == candidate || other_frames) return std::nullopt;
    std::ranges::sort(base);
    std::ranges::sort(candidate);
    std::ranges::set_symmetric_difference(base, candidate, std::back_inserter(alone));
    if (alone.empty()) return whole("in this order", "in another order");
    const bool in_base = std::ranges::binary_search(base, alone.front());
    return Difference{
        method_, name(), alone.front(), in_base ? PRESENT : ABSENT, in_base ? ABSENT : PRESENT, alone.size()};
  }

  /// The dataset with the frames of this one's rows: a table's, or those of searches.
  std::optional<std::string> frame_list() const {
    const std::size_t rows = rows_of(base_, path_), other_rows = rows_of(candidate_, path_);
    std::string place = path_.substr(0, path_.rfind('/'));
    for (; place.size() >= group_.size(); place = place.substr(0, place.rfind('/')))
      if (base_.has(place + "/frame") && candidate_.has(place + "/frame")) return place + "/frame";
    const std::string searches = group_ + "/global_frame", frames = "/path/time";
    if (base_.has(searches) && candidate_.has(searches) && rows == rows_of(base_, searches) &&
        other_rows == rows_of(candidate_, searches) &&
        (rows != rows_of(base_, frames) || other_rows != rows_of(candidate_, frames)))
      return searches;
    return std::nullopt;
  }

  /// Rows of the same frame, where the sides' lists of frames differ; none where rows have no order
  /// by frame, so that the lists are all that is reported. Unset where rows correspond as they are.
  std::optional<std::vector<std::array<std::size_t, 2>>> joined_rows() const {
    const std::optional<std::string> list = frame_list();
    if (!list) return std::nullopt;
    const std::vector<std::int64_t> a = base_.integers(*list), b = candidate_.integers(*list);
    if (a == b) return std::nullopt;
    std::vector<std::array<std::size_t, 2>> pairs;
    const auto ascends = [](const std::vector<std::int64_t>& frames) {
      return std::ranges::adjacent_find(frames, std::greater_equal<>()) == frames.end();
    };
    if (ragged() || path_.ends_with("/frame_offset") || !ascends(a) || !ascends(b) ||
        a.size() != rows_of(base_, path_) || b.size() != rows_of(candidate_, path_))
      return pairs;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i] == b[j]) pairs.push_back({i, j});
      const bool next = a[i] <= b[j], other_next = b[j] <= a[i];
      i += next ? 1 : 0;
      j += other_next ? 1 : 0;
    }
    return pairs;
  }

  template <typename Value>
  std::optional<Difference> compare_rows(const std::vector<Value>& base, const std::vector<Value>& candidate,
                                         const std::vector<std::size_t>& shape,
                                         const std::vector<std::size_t>& other,
                                         const ExactOptions& options) const {
    const std::size_t rows = shape.empty() ? 1 : shape.front(),
                      other_rows = other.empty() ? 1 : other.front();
    const std::size_t width =
        std::accumulate(shape.begin() + !shape.empty(), shape.end(), std::size_t{1}, std::multiplies<>());
    const auto joined = joined_rows();
    const std::size_t comparable = joined ? joined->size() : comparable_rows(std::min(rows, other_rows));
    const RowsEqual equal{options.tolerance_relative};
    std::optional<Difference> difference;
    for (std::size_t i = 0; i < comparable; ++i) {
      const std::size_t row = joined ? (*joined)[i][0] : i, other_row = joined ? (*joined)[i][1] : i;
      const std::span<const Value> a = std::span(base).subspan(row * width, width),
                                   b = std::span(candidate).subspan(other_row * width, width);
      if (equal(a, b)) continue;
      if (!difference) {
        std::optional<std::int64_t> frame = frame_of_row(base_, group_, dataset_, row);
        if (!frame) frame = frame_of_row(candidate_, group_, dataset_, other_row);
        difference = Difference{
            method_, name(), frame, row_value(a, shape.size() <= 1), row_value(b, shape.size() <= 1), 0};
      }
      ++difference->rows;
    }
    const bool cut_by_offsets = comparable < std::min(rows, other_rows);
    if (!joined && !difference && rows != other_rows && !cut_by_offsets && !ragged())
      return whole(shape, other);
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

/// Label of the first method of the experiment.
std::string first_method(const nlohmann::json& experiment) {
  const nlohmann::json first = setting(experiment, "/methods/0");
  return first.is_object() ? first.value("label", first.value("name", "")) : "";
}

/// Two results whose groups are compared.
struct Sides {
  const ResultReader& base;
  const ResultReader& candidate;
  nlohmann::json base_experiment = recorded_experiment(base);
  nlohmann::json candidate_experiment = recorded_experiment(candidate);
  bool same_steps = same_true_steps(base, candidate);
  bool same_methods = base.groups("/methods") == candidate.groups("/methods");
  bool same_first_method = first_method(base_experiment) == first_method(candidate_experiment);

  bool other(const std::string& pointer) const {
    return setting(base_experiment, pointer) != setting(candidate_experiment, pointer);
  }
  /// Whether a dataset is of frames or methods that the other side does not have.
  /// @param dataset as `deciding_key` takes it
  bool is_of_other_frames(const std::string& dataset) const {
    if (!same_steps && is_of_true_steps(dataset)) return true;
    if (is_of_probed_frames(dataset) && other("/probes/truth")) return true;
    // In a closed loop it is of the first method.
    if (dataset.starts_with("summary/true_lmd_count") && !base.has("/reference") && !same_first_method)
      return true;
    if (dataset.starts_with("polylines/") && other("/record/polylines")) return true;
    const bool exceptions = dataset.find("fcl/exceptions/") != std::string::npos;
    return (exceptions && !same_methods) ||
           ((exceptions || dataset.ends_with("fcl/agrees")) && other("/probes/fcl"));
  }
};

/// @param datasets in the group
void compare_datasets(const Sides& sides, const std::string& method, const std::string& group,
                      const std::vector<std::string>& datasets, const ExactOptions& options,
                      std::vector<Difference>& differences) {
  for (const std::string& dataset : datasets) {
    if (allowed(dataset, options) || is_time(sides.candidate, group, dataset)) continue;
    const std::string path = fmt::format("{}/{}", group, dataset);
    const std::string place = method.empty() ? path.substr(1) : dataset;
    if (sides.is_of_other_frames(place)) continue;
    const std::string key = deciding_key(place, !method.empty());
    if (!sides.candidate.has(path) && left_out(sides.candidate_experiment, key)) continue;
    if (auto difference = DatasetPair(sides.base, sides.candidate, method, group, dataset)
                              .compare(options, !key.empty() && sides.other(key)))
      differences.push_back(std::move(*difference));
  }
}

void compare_group(const Sides& sides, const std::string& method, const std::string& group,
                   const ExactOptions& options, std::vector<Difference>& differences) {
  compare_datasets(sides, method, group, deterministic_datasets(sides.base, group), options, differences);
}

/// Groups of the root that hold results, and what is one in /scene.
constexpr const char* RESULT_GROUPS[] = {"/reference", "/crosscheck/fcl", "/polylines", "/summary"};
constexpr const char* SCENE_RESULTS[] = {"in_contact", "torque_reference"};

void compare_root(const Sides& sides, const ExactOptions& options, std::vector<Difference>& differences) {
  for (const std::string group : RESULT_GROUPS) {
    if (sides.candidate.has(group))
      compare_group(sides, "", group, options, differences);
    else if (sides.base.has(group) &&
             !left_out(sides.candidate_experiment, deciding_key(group.substr(1) + "/", false)))
      differences.push_back({"", group, std::nullopt, PRESENT, ABSENT, 0});
  }
  std::vector<std::string> of_scene;
  std::ranges::copy_if(SCENE_RESULTS, std::back_inserter(of_scene),
                       [&](const std::string& name) { return sides.base.has("/scene/" + name); });
  compare_datasets(sides, "", "/scene", of_scene, options, differences);
}

/// The hash also covers features of LMDs that no list of the file holds. Not used with a tolerance.
void compare_hash(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                  std::vector<Difference>& differences) {
  const std::string group = "/methods/" + method;
  const auto a = base.text_attribute(group, "result_hash"),
             b = candidate.text_attribute(group, "result_hash");
  if (a == b) return;
  const auto shown = [](const std::optional<std::string>& hash) {
    return nlohmann::json(hash.value_or(ABSENT));
  };
  differences.push_back({method, "result_hash", std::nullopt, shown(a), shown(b), 0});
}

}  // namespace

nlohmann::json recorded_experiment(const ResultReader& file) {
  const std::vector<std::string> texts =
      file.has(EXPERIMENT) ? file.texts(EXPERIMENT) : std::vector<std::string>{};
  return nlohmann::json::parse(texts.empty() ? "" : texts.front(), nullptr, false);
}

bool same_true_steps(const ResultReader& base, const ResultReader& candidate) {
  const auto of_every_frame = [](const ResultReader& file) {
    return !file.text_attribute("/summary", "truth_of_every_frame").value_or("").empty();
  };
  return of_every_frame(base) == of_every_frame(candidate);
}

std::vector<Difference> exact_differences(const ResultReader& base, const ResultReader& candidate,
                                          const ExactOptions& options) {
  std::vector<Difference> differences;
  const Sides sides{base, candidate};
  for (const std::string& method : base.groups("/methods")) {
    const std::string group = "/methods/" + method;
    if (!candidate.has(group)) {
      differences.push_back({method, "", std::nullopt, PRESENT, ABSENT, 0});
      continue;
    }
    std::vector<Difference> of_method;
    compare_group(sides, method, group, options, of_method);
    const bool explained = std::any_of(of_method.begin(), of_method.end(), [](const Difference& d) {
      return !is_counter_group(d.dataset.substr(0, d.dataset.find('/')));
    });
    if (!explained && options.tolerance_relative == 0.0) compare_hash(base, candidate, method, of_method);
    std::move(of_method.begin(), of_method.end(), std::back_inserter(differences));
  }
  compare_root(sides, options, differences);
  std::sort(differences.begin(), differences.end(), reported_before);
  return differences;
}

std::vector<Difference> group_differences(const ResultReader& base, const ResultReader& candidate,
                                          const std::string& group) {
  std::vector<Difference> differences;
  compare_group({base, candidate}, "", group, {}, differences);
  return differences;
}

std::vector<std::string> additions(const ResultReader& base, const ResultReader& candidate) {
  std::vector<std::string> names;
  const nlohmann::json experiment = recorded_experiment(base);
  for (const std::string& method : candidate.groups("/methods")) {
    const std::string group = "/methods/" + method;
    if (!base.has(group)) {
      names.push_back("method " + method);
      continue;
    }
    for (const std::string& dataset : deterministic_datasets(candidate, group))
      if (!base.has(fmt::format("{}/{}", group, dataset)) &&
          !left_out(experiment, deciding_key(dataset, true)))
        names.push_back(fmt::format("{}/{}", method, dataset));
  }
  for (const std::string group : RESULT_GROUPS)
    if (candidate.has(group) && !base.has(group) &&
        !left_out(experiment, deciding_key(group.substr(1) + "/", false)))
      names.push_back(group);
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
