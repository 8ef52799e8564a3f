// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/defaults.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/prepare.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// A look at the inputs before a run: what they are, and what is suspicious. Nothing here stops a
/// run, since every odd scene is somebody's experiment.
namespace lmdbench {

/// Something that is likely a mistake, with its number.
struct SceneWarning {
  std::string what;
  std::string remedy;
};
/// "what (remedy: ...)".
std::string to_text(const SceneWarning& warning);

/// Diagonals that differ by more than this are likely in different units.
inline constexpr double UNLIKELY_SIZE_RATIO = 100.0;
/// In one unit, diagonals with a ratio within this factor of 25.4 may be in inches and millimetres.
inline constexpr double INCH_RATIO_FACTOR = 1.5;
/// A larger mesh is likely not in metres, unless its unit is given [m].
inline constexpr double UNLIKELY_SIZE = 3.0;
/// Frames tested for one mesh inside the other: evenly spread over the path.
inline constexpr std::int64_t INSIDE_SAMPLES = 32;
/// Expected time of a stage.
struct ExpectedTime {
  std::string stage;
  double seconds = 0.0;
};

struct SceneLook {
  struct Mesh {
    std::string role;
    std::string name;
    std::int64_t triangles = 0;
    double diagonal = 0.0;  ///< metres
    bool closed = false;
    std::int64_t instances = 0;  ///< 0: it is in the world frame.
    /// Metres assumed for a unit of its file; unset where the experiment gives its size.
    std::optional<double> unit = 1.0;
    bool unit_is_said = false;  ///< Given by the experiment or the file's format.
  };
  std::vector<Mesh> meshes;
  double cutoff = 0.0;         ///< metres
  double saturation = 0.0;     ///< metres
  double maximum_force = 0.0;  ///< Of one LMD [N].
  double force_limit = 0.0;    ///< Limit of the sum [N].
  std::int64_t frames = 0;
  std::int64_t frames_in_contact = 0;  ///< Of the first profile.
  bool several_profiles = false;
  /// Without a frame in contact: the least distance of the path [m], and its frame.
  double nearest = std::numeric_limits<double>::quiet_NaN();
  std::int64_t nearest_frame = -1;
  std::vector<DefaultNote> defaults;
  std::vector<SceneWarning> warnings;
  std::vector<ExpectedTime> times;  ///< Empty if not asked for.
};

/// Warnings of loaded meshes whose sizes suggest another unit.
std::vector<SceneWarning> size_warnings(const Experiment& experiment, const std::vector<MeshNote>& notes);

/// @param in_contact  one a frame of the path (contact.h)
SceneLook look_at(const Experiment& experiment, const PreparedRun& prepared,
                  const std::vector<bool>& in_contact);

std::string to_text(const SceneLook& look);
/// Keys as the members above; "warnings": [{"what", "remedy"}].
nlohmann::ordered_json to_json(const SceneLook& look);

/// Frames of the path at which a search is timed.
inline constexpr std::int64_t TIMED_FRAMES = 8;

/// Expected times of a run, from searches at a few frames: each method's searches from scratch
/// (without tracking, coherence and FCL) and the truth probe. Right within a factor of a few.
std::vector<ExpectedTime> expected_times(const Experiment& experiment, const PreparedRun& prepared);

}  // namespace lmdbench
