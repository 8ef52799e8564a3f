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

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace lmdbench {
namespace {

constexpr std::size_t MOST_FRAMES = 600;

}  // namespace

void write_report_scene(const ResultReader& result, const std::filesystem::path& folder) {
  const ResultScene result_scene = deforming_scene_of_result(result);
  if (result_scene.deformation)
    throw UsageError(result.file().string(), "", "the view does not draw meshes that deform",
                     "lmdbench export writes the shape of each frame, for ParaView");
  if (result_scene.movers)
    throw UsageError(result.file().string(), "", "the view draws one mesh that moves",
                     "lmdbench export writes all movers at their poses, for ParaView");
  const Scene& scene = result_scene.rest;
  write_off(folder / "moving.off", scene.moving->surface().mesh);
  const std::vector<ResultTrack> tracks = tracks_of_result(result, MOST_FRAMES);
  for (const std::size_t i : drawn_bodies(scene, tracks))
    write_off(folder / fmt::format("fixed_{}.off", i), placed_mesh(scene.fixed[i]));

  const std::unique_ptr<Method> method = exact_method(scene);
  std::string lines;
  for (const ResultTrack& track : tracks)
    for (std::size_t i = 0; i < track.poses.size(); ++i) {
      const std::string line =
          query_json(query(*method, track.poses[i].pose, scene.cutoff, track.poses[i].time));
      lines += fmt::format("{{\"frame\":{},\"track\":{},{}\n", track.frames[i],
                           nlohmann::json(track.method).dump(), std::string_view(line).substr(1));
    }
  write_file_atomically(folder / "lmds.jsonl", lines);
}

}  // namespace lmdbench
