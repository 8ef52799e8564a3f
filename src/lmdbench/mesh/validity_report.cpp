// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/validity.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lmdbench {

namespace {

constexpr const char* TURN_REMEDY =
    "remedy: \"orient\": \"outward\" in an experiment, --orient outward of init and query";

template <typename T>
nlohmann::ordered_json json_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string counted(std::int64_t count, const char* singular, const char* plural) {
  return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

}  // namespace

std::vector<std::string> findings(const ValidityReport& report) {
  std::vector<std::string> sentences;
  if (report.non_manifold_edges > 0)
    sentences.push_back(fmt::format("{} with more than two triangles: no outer side there",
                                    counted(report.non_manifold_edges, "edge", "edges")));
  if (report.non_manifold_vertices > 0)
    sentences.push_back(fmt::format("{} where surfaces touch in a point only",
                                    counted(report.non_manifold_vertices, "vertex", "vertices")));
  if (report.misoriented_edges > 0)
    sentences.push_back(fmt::format("{} whose two triangles disagree on the outer side ({})",
                                    counted(report.misoriented_edges, "edge", "edges"), TURN_REMEDY));
  if (report.outward == false)
    sentences.push_back(
        fmt::format("inside out: the normals of {} of {} triangles point into the solid, so that nothing "
                    "outside of it is a contact of theirs in truth ({})",
                    report.inward_triangles, report.triangles, TURN_REMEDY));
  if (!report.closed)
    sentences.push_back(fmt::format("open: {} in {}",
                                    counted(report.boundary_edges, "boundary edge", "boundary edges"),
                                    counted(report.boundary_loops, "loop", "loops")));
  if (report.degenerate_triangles > 0)
    sentences.push_back(
        fmt::format("{} without area", counted(report.degenerate_triangles, "triangle", "triangles")));
  if (report.duplicate_triangles > 0)
    sentences.push_back(fmt::format("{} on the same vertices as another",
                                    counted(report.duplicate_triangles, "triangle", "triangles")));
  return sentences;
}

nlohmann::ordered_json to_json(const ValidityReport& report) {
  return {{"vertices", report.vertices},
          {"edges", report.edges},
          {"triangles", report.triangles},
          {"unused_vertices", report.unused_vertices},
          {"components", report.components},
          {"closed", report.closed},
          {"boundary_edges", report.boundary_edges},
          {"boundary_loops", report.boundary_loops},
          {"manifold", report.manifold},
          {"non_manifold_edges", report.non_manifold_edges},
          {"non_manifold_vertices", report.non_manifold_vertices},
          {"consistently_oriented", report.consistently_oriented},
          {"misoriented_edges", report.misoriented_edges},
          {"outward", json_or_null(report.outward)},
          {"inward_triangles", report.inward_triangles},
          {"genus", json_or_null(report.genus)},
          {"degenerate_triangles", report.degenerate_triangles},
          {"duplicate_triangles", report.duplicate_triangles},
          {"area", report.area},
          {"volume", json_or_null(report.volume)},
          {"diagonal", report.diagonal},
          {"mean_edge_length", report.mean_edge_length},
          {"shortest_edge", report.shortest_edge},
          {"longest_edge", report.longest_edge},
          {"worst_aspect", report.worst_aspect},
          {"findings", findings(report)}};
}

std::string to_text(const ValidityReport& report) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "triangles     {}, vertices {}, edges {}, components {}\n", report.triangles,
                 report.vertices, report.edges, report.components);
  fmt::format_to(out, "surface       {}, {}, {}", report.closed ? "closed" : "open",
                 report.manifold ? "manifold" : "not manifold",
                 report.consistently_oriented ? "consistently oriented" : "not consistently oriented");
  if (report.genus) fmt::format_to(out, ", genus {}", *report.genus);
  fmt::format_to(out, "\nsize          diagonal {:.6g}, area {:.6g}", report.diagonal, report.area);
  if (report.volume) fmt::format_to(out, ", volume {:.6g}", *report.volume);
  fmt::format_to(out, "\nedges         mean {:.6g}, shortest {:.6g}, longest {:.6g}; worst aspect {:.4g}\n",
                 report.mean_edge_length, report.shortest_edge, report.longest_edge, report.worst_aspect);
  for (const std::string& sentence : findings(report)) fmt::format_to(out, "finding       {}\n", sentence);
  return fmt::to_string(text);
}

}  // namespace lmdbench
