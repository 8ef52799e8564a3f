// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/methods/query.h>
#include <lmdbench/result/result_scene.h>
#include <lmdbench/view/report_scene.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace lmdbench {
namespace {

constexpr std::size_t MOST_FRAMES = 600;
/// Movers times frames: with more the page shows fewer frames.
constexpr std::size_t MOST_MOVER_POSES = 30000;

/// One mesh an entry of `/movers`; where each of its movers is the page reads in the result.
void write_movers(const ResultReader& result, const MoverPlay& play, const std::filesystem::path& folder) {
  for (std::size_t entry = 0;; ++entry) {
    const std::string role = fmt::format("mover_{}", entry);
    const auto first = result.integer_attribute("/scene/" + role, "first_mover");
    if (!first) return;
    const auto mover = std::ranges::find(play.number, static_cast<std::size_t>(*first));
    write_off(folder / (role + ".off"),
              play.bodies.at(static_cast<std::size_t>(mover - play.number.begin()))->surface().mesh);
  }
}

}  // namespace

void write_report_scene(const ResultReader& result, const std::filesystem::path& folder) {
  const ResultScene result_scene = deforming_scene_of_result(result);
  if (result_scene.deformation)
    throw UsageError(result.file().string(), "", "the view does not draw meshes that deform",
                     "lmdbench export writes the shape of each frame, for ParaView");
  const Scene& scene = result_scene.rest;
  write_off(folder / "moving.off", scene.moving->surface().mesh);
  const MoverPlay* play = result_scene.movers.get();
  if (play != nullptr) write_movers(result, *play, folder);
  const std::size_t frames = play != nullptr
                                 ? std::clamp<std::size_t>(MOST_MOVER_POSES / play->count(), 1, MOST_FRAMES)
                                 : MOST_FRAMES;
  const std::vector<ResultTrack> tracks = tracks_of_result(result, frames);
  for (const std::size_t i : drawn_bodies(scene, tracks))
    write_off(folder / fmt::format("fixed_{}.off", i), placed_mesh(scene.fixed[i]));

  const auto poses = std::make_shared<std::vector<Pose>>();
  const std::unique_ptr<Method> method =
      play != nullptr ? exact_method(play->scene(scene.cutoff), poses) : exact_method(scene);
  std::string lines;
  for (const ResultTrack& track : tracks)
    for (std::size_t i = 0; i < track.poses.size(); ++i) {
      if (play != nullptr) *poses = play->poses[track.frames[i]];
      const std::string line =
          query_json(query(*method, track.poses[i].pose, scene.cutoff, track.poses[i].time));
      lines += fmt::format("{{\"frame\":{},\"track\":{},{}\n", track.frames[i],
                           nlohmann::json(track.method).dump(), std::string_view(line).substr(1));
    }
  write_file_atomically(folder / "lmds.jsonl", lines);
}

}  // namespace lmdbench
