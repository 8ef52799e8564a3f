// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/prepare/scene_warnings.h>

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench {
namespace {

/// A mesh of the manifest that other tools built, or that somebody changed.
bool differs_from_manifest(const MeshNote& note, const std::filesystem::path& mesh_folder) {
  if (!note.file || !is_mesh_name(note.name)) return false;
  const Manifest manifest = load_manifest(mesh_folder / "manifest.json");
  const ManifestEntry* const entry = manifest.find(note.name);
  return entry != nullptr && !entry->sha256.empty() && entry->sha256 != note.sha256;
}

}  // namespace

std::vector<std::string> deformation_warnings(const std::vector<MeshNote>& notes,
                                              const SceneDeformation* deformation, bool path_is_made) {
  std::vector<std::string> warnings;
  if (deformation == nullptr) return warnings;
  for (const MeshNote& note : notes) {
    if (!note.vertices) continue;
    const std::vector<DeformationStep>& steps = deformation->find(note.body.get())->steps;
    const auto warn = [&](const char* what, std::int64_t DeformationStep::*count,
                          std::int32_t DeformationStep::*first) {
      std::int64_t all = 0, frames = 0;
      std::string where;
      for (std::size_t frame = 0; frame < steps.size(); ++frame) {
        if (steps[frame].*count == 0) continue;
        if (frames++ == 0) where = fmt::format("triangle {} in frame {}", steps[frame].*first, frame);
        all += steps[frame].*count;
      }
      if (all > 0)
        warnings.emplace_back(fmt::format(
            "{} mesh {}: as it deforms, triangles {} {} times, in {} of {} frames, first {}; the mesh "
            "is taken as its vertices say",
            note.role, note.name, what, all, frames, steps.size(), where));
    };
    warn("turn over", &DeformationStep::turned_over, &DeformationStep::first_turned_over);
    warn("lose their area", &DeformationStep::lost_area, &DeformationStep::first_lost_area);
  }
  if (path_is_made)
    warnings.emplace_back(
        "the path is made for the meshes at rest: as they deform they may intersect, or not meet");
  return warnings;
}

std::vector<std::string> mesh_warnings(const Experiment& experiment, const std::vector<MeshNote>& notes) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const MeshNote& note = notes[i];
    const auto warn = [&](const std::string& text) {
      warnings.push_back(fmt::format("{} mesh {}: {}", note.role, note.name, text));
    };
    if (const std::size_t coincident = count_coincident(note.instances); coincident > 0)
      warn(
          fmt::format("{} of {} instances are just where an earlier one is: each of their LMDs is there once "
                      "an instance",
                      coincident, note.instances.size()));
    // A mesh used twice gets its warnings once.
    if (earlier_body(experiment, i)) continue;
    if (differs_from_manifest(note, experiment.mesh_folder))
      warn("its file is not the manifest's: results on it do not compare frame by frame with others'");
    if (const std::string repairs = repairs_text(note.flattening); !repairs.empty()) warn(repairs);
    if (says_something(note.flattening)) warn(to_text(note.flattening));
    if (note.orientation.choice == OrientationChoice::OUTWARD) warn(to_text(note.orientation));
    for (const std::string& finding : findings(note.report)) warn(finding);
  }
  return warnings;
}

std::vector<std::string> aggregation_warnings(const Experiment& experiment,
                                              const std::vector<MeshNote>& notes) {
  std::vector<std::string> warnings;
  bool asks_indices = false;
  for (const MethodChoice& method : experiment.methods) {
    const Aggregation& wanted = *experiment.profiles[method.profile].aggregation;
    asks_indices = asks_indices || method.aggregation->needs != AggregationNeeds::MINIMA;
    if (method.aggregation != &wanted)
      warnings.push_back(
          fmt::format("method {} finds no saddles, which the aggregation \"{}\" needs: its LMDs are summed, "
                      "and its force errors "
                      "are against the force that was asked for",
                      method.label, wanted.name));
  }
  for (const MeshNote& note : notes)
    if (asks_indices && !(note.report.closed && note.report.manifold))
      warnings.push_back(
          fmt::format("{} mesh {}: LMDs at its {} boundary edges and {} edges and vertices that are not "
                      "manifold have no index: "
                      "where one is born or dies the force may jump",
                      note.role, note.name, note.report.boundary_edges,
                      note.report.non_manifold_edges + note.report.non_manifold_vertices));
  return warnings;
}

}  // namespace lmdbench
