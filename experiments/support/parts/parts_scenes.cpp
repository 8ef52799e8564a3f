// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/catalogue/sleeve.h>
#include <lmdbench/lmd/body_distance.h>

#include <support/parts/chances.h>
#include <support/parts/formed_poses.h>
#include <support/parts/formed_shapes.h>
#include <support/parts/machine_parts.h>
#include <support/parts/parts_scenes.h>
#include <support/parts/placement.h>
#include <support/parts/random_solids.h>
#include <support/parts/recut.h>
#include <support/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace lmdbench::parts {
namespace {

using experiments::Random;

const std::array KINDS = {
    PartsKind{"plate on plate", "plate", "plate"},
    PartsKind{"block on block", "block", "block"},
    PartsKind{"ring on ring", "ring", "ring"},
    PartsKind{"gear on gear", "gear", "gear"},
    PartsKind{"involute gear on involute gear", "involute gear", "involute gear"},
    PartsKind{"slit plate on ring", "slit plate", "ring"},
    PartsKind{"slit plate on slit plate", "slit plate", "slit plate"},
    PartsKind{"nut on slotted plate", "nut", "slotted plate"},
    PartsKind{"comb on comb", "comb", "comb"},
    PartsKind{"ribbed plate on ribbed plate", "ribbed plate", "ribbed plate"},
    PartsKind{"waffle on egg crate", "waffle", "egg crate"},
    PartsKind{"egg crate on egg crate", "egg crate", "egg crate"},
    PartsKind{"perforated sheet on perforated sheet", "perforated sheet", "perforated sheet"},
    PartsKind{"block on perforated sheet", "block", "perforated sheet"},
    PartsKind{"honeycomb on louvres", "honeycomb", "louvres"},
    PartsKind{"honeycomb on honeycomb", "honeycomb", "honeycomb"},
    PartsKind{"thin ring on spoked wheel", "thin ring", "spoked wheel"},
    PartsKind{"retaining ring on gear", "retaining ring", "gear"},
    PartsKind{"sprocket on ratchet", "sprocket", "ratchet"},
    PartsKind{"castellated nut on nut", "castellated nut", "nut"},
    PartsKind{"hex bolt on ring", "hex bolt", "ring"},
    PartsKind{"stepped shaft on plate", "stepped shaft", "plate"},
    PartsKind{"grooved shaft on U channel", "grooved shaft", "U channel"},
    PartsKind{"bush on cross", "bush", "cross"},
    PartsKind{"T-nut on keyway", "T-nut", "keyway"},
    PartsKind{"L bracket on I beam", "L bracket", "I beam"},
    PartsKind{"star on star", "star", "star"},
    PartsKind{"cross on star", "cross", "star"},
    PartsKind{"stairs on stairs", "stairs", "stairs"},
    PartsKind{"crenellated wall on crenellated wall", "crenellated wall", "crenellated wall"},
    PartsKind{"wedge on stairs", "wedge", "stairs"},
    PartsKind{"frustum on perforated sheet", "frustum", "perforated sheet"},
    PartsKind{"dome on egg crate", "dome", "egg crate"},
    PartsKind{"cup on tray", "cup", "tray"},
    PartsKind{"slotted tube on slotted plate", "slotted tube", "slotted plate"},
    PartsKind{"cage on cage", "cage", "cage"},
    PartsKind{"cross-drilled cube on waffle", "cross-drilled cube", "waffle"},
    PartsKind{"pyramid on pyramid", "pyramid of steps", "pyramid of steps"},
    PartsKind{"half pipe on rack", "half pipe", "rack"},
    PartsKind{"rack on rack", "rack", "rack"},
    PartsKind{"sawtooth on sawtooth", "sawtooth", "sawtooth"},
    PartsKind{"louvres on comb", "louvres", "comb"},
    PartsKind{"V-block on ridge", "V-block", "ridge"},
    PartsKind{"threaded rod on V-block", "threaded rod", "V-block"},
    PartsKind{"spline shaft on ring", "spline shaft", "ring"},
    PartsKind{"funnel on frustum", "funnel", "frustum"},
    PartsKind{"square peg in its bore", "square peg", "square bore", true},
    PartsKind{"hexagonal peg in its bore", "hexagonal peg", "hexagonal bore", true},
    PartsKind{"peg of 32 sides in its bore", "peg of 32 sides", "bore of 32 sides", true},
    PartsKind{"shaft in bush", "plain shaft", "bush", true},
    PartsKind{"key in keyway", "key", "keyway", true},
    PartsKind{"T-nut in T-slot", "T-nut", "T-slot", true},
    PartsKind{"dovetail in its way", "dovetail", "dovetail way", true},
    PartsKind{"box in tray", "box for the tray", "tray", true},
    PartsKind{"spline shaft in its hub", "spline shaft", "spline hub", true},
    PartsKind{"threaded rod in threaded nut", "threaded rod", "threaded nut", true},
    PartsKind{"frustum in funnel", "frustum", "funnel", true},
    PartsKind{"ridge in V-block", "ridge", "V-block", true},
    PartsKind{"any part on any part", "", ""},
};

/// Special names of the second part: the same mesh, its mate, or any two shapes.
constexpr const char *ITS_COPY = "its copy", *ITS_MATE = "its mate", *ANY_FORMED = "any formed shape";
constexpr const char *TURNED_MATES = "turned mates", *RELIEF_MATES = "relief mates";

const std::array CLEAR_KINDS = {
    PartsKind{"square plate on oblong plate", "square plate", "oblong plate"},
    PartsKind{"box on box", "low box", "high box"},
    PartsKind{"box on its copy", "cube", ITS_COPY},
    PartsKind{"plate with a hole on a plate", "holed plate", "coarse plate"},
    PartsKind{"box over a hole", "bar", "holed plate"},
    PartsKind{"frame on frame", "frame", "frame"},
    PartsKind{"L-block on L-block", "small L-block", "L-block"},
    PartsKind{"two boxes on a gear", "two boxes", "involute gear"},
    PartsKind{"wedge on a plate with a hole", "long wedge", "holed plate"},
};

constexpr const char *POLYCUBE = "polycube", *STAR_PRISM = "star prism";

const std::array RANDOM_KINDS = {
    PartsKind{"polycube on polycube", POLYCUBE, POLYCUBE},
    PartsKind{"star prism on star prism", STAR_PRISM, STAR_PRISM},
    PartsKind{"star prism on polycube", STAR_PRISM, POLYCUBE},
};

const std::array FORMED_KINDS = {
    PartsKind{"turned part on turned part", "turned part", "turned part"},
    PartsKind{"turned part on its copy", "turned part", ITS_COPY},
    PartsKind{"turned part in its bore", TURNED_MATES, ITS_MATE},
    PartsKind{"coil on coil", "coil", "coil"},
    PartsKind{"coil on its copy", "coil", ITS_COPY},
    PartsKind{"coil on turned part", "coil", "turned part"},
    PartsKind{"slit block on slit block", "slit block", "slit block"},
    PartsKind{"slit block on its copy", "slit block", ITS_COPY},
    PartsKind{"slit block on thin plate", "slit block", "thin plate"},
    PartsKind{"thin plate on thin plate", "thin plate", "thin plate"},
    PartsKind{"stellated solid on stellated solid", "stellated solid", "stellated solid"},
    PartsKind{"stellated solid on its copy", "stellated solid", ITS_COPY},
    PartsKind{"cast on relief", RELIEF_MATES, ITS_MATE},
    PartsKind{"scan on scan", "scan", "scan"},
    PartsKind{"scan on its copy", "scan", ITS_COPY},
    PartsKind{"truss on bricks", "truss", "bricks"},
    PartsKind{"bricks on bricks", "bricks", "bricks"},
    PartsKind{"any formed shape on any formed shape", ANY_FORMED, ANY_FORMED},
};

struct Family {
  Generator generator;
  std::span<const PartsKind> kinds;
};
/// The indices of families and kinds seed the draws of a kind (random_of).
const std::array FAMILIES = {
    Family{Generator::MACHINE_PARTS, KINDS}, Family{Generator::CLEAR_SHAPES, CLEAR_KINDS},
    Family{Generator::RANDOM_SOLIDS, RANDOM_KINDS}, Family{Generator::FORMED_SHAPES, FORMED_KINDS}};

const Family& family_of(const PartsKind& kind) {
  return *std::ranges::find_if(FAMILIES, [&](const Family& family) {
    return std::ranges::any_of(family.kinds, [&](const PartsKind& each) { return &each == &kind; });
  });
}

/// Shapes of CLEAR_KINDS: grids of boxes, shapes with holes, not convex, or of two components.
const std::map<std::string_view, TriangleMesh>& clear_shapes() {
  static const std::map<std::string_view, TriangleMesh> SHAPES = {
      {"square plate", make_box({1.0, 1.0, 0.1}, {4, 4, 1})},
      {"oblong plate", make_box({1.3, 0.9, 0.1}, {3, 4, 1})},
      {"coarse plate", make_box({1.0, 1.0, 0.1}, {3, 3, 1})},
      {"low box", make_box({0.7, 0.5, 0.4}, 3)},
      {"high box", make_box({0.6, 0.6, 0.5}, 2)},
      {"cube", make_box({0.5, 0.5, 0.5}, 2)},
      {"bar", make_box({0.8, 0.2, 0.3}, 2)},
      {"frame", make_sleeve(polygon_outline(4, 0.5), polygon_outline(4, 0.3), {.height = 0.2, .around = 24})},
      {"holed plate",
       make_sleeve(polygon_outline(4, 0.6), circle_outline(0.25), {.height = 0.1, .around = 32, .rings = 3})},
      {"small L-block", make_l_block(1.0)},
      {"L-block", make_l_block(1.3)},
      {"two boxes", make_two_boxes({0.3, 0.4, 0.3}, 0.15)},
      {"long wedge", make_wedge(0.3, 0.8, 0.3)},
  };
  return SHAPES;
}

/// One of the 24 turns of a cube: exact.
Mat3 quarter_turns(Random& random) {
  std::array<Eigen::Index, 3> axis = {0, 1, 2};
  for (std::size_t i = 3; i > 1; --i) std::swap(axis[i - 1], axis[random.index(i)]);
  Mat3 turn = Mat3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i)
    turn(i, axis[static_cast<std::size_t>(i)]) = chance(0.5, random) ? 1.0 : -1.0;
  if (turn.determinant() < 0.0) turn.row(0) *= -1.0;
  return turn;
}

/// Unturned, turned about the vertical axis, or on any of its sides.
TriangleMesh on_some_side(TriangleMesh mesh, Random& random) {
  const Mat3 turn = quarter_turns(random);
  if (chance(0.6, random)) return mesh;
  for (Vec3& p : mesh.vertices) p = turn * p;
  return mesh;
}

/// The highest vertices in a direction along z: height, corners, borders.
struct Level {
  double height = 0.0;
  std::vector<Vec3> corners;
  std::vector<std::array<Vec3, 2>> borders;
};

/// @param up 1 for the upper side, -1 for the lower one
Level level_of(const TriangleMesh& mesh, const Eigen::Quaterniond& rotation, double up) {
  std::vector<Vec3> vertices;
  for (const Vec3& p : mesh.vertices) vertices.push_back(rotation * p);
  double height = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : vertices) height = std::max(height, up * p.z());
  const auto there = [&](std::int32_t v) {
    return up * vertices[static_cast<std::size_t>(v)].z() >= height - 1e-9;
  };
  Level level{up * height, {}, {}};
  for (const auto& corners : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = corners[i], b = corners[(i + 1) % 3];
      if (!there(a)) continue;
      level.corners.push_back(vertices[static_cast<std::size_t>(a)]);
      if (there(b)) level.borders.push_back({level.corners.back(), vertices[static_cast<std::size_t>(b)]});
    }
  }
  return level;
}

double angle_of(const std::array<Vec3, 2>& border) {
  const Vec3 way = border[1] - border[0];
  return std::atan2(way.y(), way.x());
}

Eigen::Quaterniond about_z(double angle) {
  // No turn is exactly the identity.
  return angle == 0.0 ? Eigen::Quaterniond::Identity()
                      : Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

Vec3 level_direction(Random& random) {
  if (chance(0.3, random)) return random.index(2) == 0 ? Vec3::UnitX() : Vec3::UnitY();
  const double angle = TAU * random.uniform();
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// [m]
constexpr double CLEAR_GAP = CUTOFF / 40.0;

class PoseMaker {
 public:
  PoseMaker(const PartsDesign& design, bool nested, Generator generator, PoseFamily family)
      : design_(design),
        nested_(nested),
        generator_(generator),
        flush_(family == PoseFamily::FLUSH),
        moving_("moving", build_surface(design.moving)),
        fixed_("fixed", build_surface(design.fixed)) {}

  Pose unrelated(Random& random) const {
    if (generator_ == Generator::CLEAR_SHAPES && !flush_) return clearly_on_it(random);
    if (generator_ != Generator::MACHINE_PARTS && !flush_)
      return (generator_ == Generator::FORMED_SHAPES ? formed_pose : face_on_face)(design_.moving,
                                                                                   design_.fixed, random);
    Pose pose = nested_ ? in_it(random) : on_it(random);
    if (flush_)
      for (double& x : pose.translation) x = dyadic(x, 24);
    return pose;
  }

 private:
  /// Puts a side over the other's without a tilt, a fortieth of the cutoff above it; only
  /// directions are aligned.
  Pose clearly_on_it(Random& random) const {
    Pose pose;
    pose.rotation = about_z(chance(1.0 / 3.0, random) ? 0.25 * TAU * static_cast<double>(random.index(4))
                                                      : TAU * random.uniform());
    pose.translation = Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 3.0);
    descend(pose, CLEAR_GAP);
    return pose;
  }

  /// Puts a side over the other's.
  Pose on_it(Random& random) const {
    Pose pose;
    const double alignment = random.uniform();
    double spin = chance(0.4, random) ? 0.0 : TAU * random.uniform();
    if (!flush_ && spin == 0.0) spin += tiny(0.3, -14.0, -4.0, random);
    const Level above = level_of(design_.fixed, Eigen::Quaterniond::Identity(), 1.0);
    Level below = level_of(design_.moving, about_z(spin), -1.0);
    const double reach =
        0.4 * (bounding_box_diagonal(design_.moving) + bounding_box_diagonal(design_.fixed)) / 2.0;
    const double offset = tiny(0.6, -16.0, -5.0, random);
    if (alignment < 0.15) {
      // A corner over a corner.
      const Vec3 &on = above.corners[random.index(above.corners.size())],
                 &at = below.corners[random.index(below.corners.size())];
      pose.translation = on - at + offset * level_direction(random);
    } else if (alignment < 0.35 && !above.borders.empty() && !below.borders.empty()) {
      // A border along a border.
      const auto& on = above.borders[random.index(above.borders.size())];
      const std::size_t which = random.index(below.borders.size());
      if (spin != 0.0 && !flush_) {
        spin += angle_of(on) - angle_of(below.borders[which]) + (chance(0.5, random) ? 0.0 : 0.5 * TAU) +
                tiny(0.5, -14.0, -4.0, random);
        below = level_of(design_.moving, about_z(spin), -1.0);
      }
      const auto& at = below.borders[std::min(which, below.borders.size() - 1)];
      const Vec3 along = (on[1] - on[0]).normalized();
      pose.translation = on[0] + random.uniform() * (on[1] - on[0]) - at[0] -
                         random.uniform() * (at[1] - at[0]) + offset * along.cross(Vec3::UnitZ());
    } else if (alignment < 0.5) {
      // Multiples of a sixteenth, like the parts' own sizes.
      for (double& x : pose.translation) x = std::round(random.uniform(-8.0, 8.0)) / 16.0 + offset;
    } else {
      for (double& x : pose.translation) x = random.uniform(-reach, reach);
    }
    pose.rotation = about_z(spin);
    const double tilt = flush_ ? 0.0 : tiny(0.6, -13.0, -3.0, random);
    if (tilt != 0.0) pose.rotation = Eigen::AngleAxisd(tilt, level_direction(random)) * pose.rotation;
    const double gap = flush_ ? CUTOFF * std::pow(10.0, random.uniform(-5.0, 0.0)) : draw_gap(random);
    pose.translation.z() = above.height - below.height + std::max(gap, std::abs(tilt));
    if (gap > 0.0) descend(pose, gap);
    if (gap <= 0.0 || chance(0.5, random)) pose.translation.z() = above.height - below.height + gap;
    return pose;
  }

  /// Distance is 1-Lipschitz in translation: a few steps of the remaining gap come near enough.
  void descend(Pose& pose, double gap) const {
    for (int step = 0; step < 6; ++step) {
      const double left = nearest_pair(moving_, fixed_, pose).distance - gap;
      if (!(left > 1e-3 * gap)) break;
      pose.translation.z() -= left;
    }
  }

  /// Off the central seat by part of the clearance.
  Pose in_it(Random& random) const {
    Pose pose;
    const double how = random.uniform();
    double off = CLEARANCE * random.uniform();
    if (how < 0.3) off = 0.0;
    if (!flush_ && how > 0.6) off = CLEARANCE * (1.0 - decades(-9.0, -2.0, random));
    if (!flush_ && how > 0.9) off = CLEARANCE;
    pose.translation = off * level_direction(random);
    const double lift = random.uniform();
    if (lift > 0.3) pose.translation.z() = CLEARANCE * random.uniform(-1.0, 1.0);
    if (lift > 0.6) pose.translation.z() = random.uniform(-0.25, 0.25);
    if (flush_) return pose;
    pose.rotation = about_z(tiny(0.5, -13.0, -2.0, random));
    const double tilt = tiny(0.5, -13.0, -2.5, random);
    if (tilt != 0.0) pose.rotation = Eigen::AngleAxisd(tilt, level_direction(random)) * pose.rotation;
    return pose;
  }

  const PartsDesign& design_;
  bool nested_;
  Generator generator_;
  bool flush_;
  Body moving_, fixed_;
};

/// A mesh as stored in a file, and the pose of the design in it.
struct File {
  std::shared_ptr<const Body> body;
  Pose X_FD;  ///< From the frame of the design to that of the file.
};

File file_of(const char* name, TriangleMesh mesh, Coordinates coordinates, Random& random) {
  File file;
  if (coordinates == Coordinates::RECUT) mesh = recut(std::move(mesh), random);
  if (coordinates == Coordinates::TURNED || coordinates == Coordinates::ROUNDED)
    file.X_FD = random_placement(0.5, random);
  file.body = placed_body(name, std::move(mesh), file.X_FD, coordinates == Coordinates::ROUNDED);
  return file;
}

/// Seeds are spread so that no two scenes draw the same numbers.
Random random_of(const PartsChoice& choice, std::uint64_t stream) {
  const PartsKind& kind = parts_kind(choice.kind);
  const Family& family = family_of(kind);
  const auto number =
      static_cast<std::uint64_t>(500 * (&family - FAMILIES.data()) + (&kind - family.kinds.data()));
  return Random((choice.seed * 2000 + number) * 0x9E3779B97F4A7C15ULL + 8 * choice.index + stream);
}

}  // namespace

const char* name_of(Coordinates coordinates) {
  constexpr std::array NAMES = {"exact", "turned", "rounded", "recut"};
  return NAMES.at(static_cast<std::size_t>(coordinates));
}

std::span<const PartsKind> parts_kinds(Generator generator) {
  return std::ranges::find(FAMILIES, generator, &Family::generator)->kinds;
}

const PartsKind& parts_kind(std::string_view name) {
  std::string names;
  for (const Family& family : FAMILIES) {
    for (const PartsKind& kind : family.kinds) {
      if (name == kind.name) return kind;
      names += (names.empty() ? "" : ", ") + std::string(kind.name);
    }
  }
  throw UsageError("", "--kind", "there is no kind '" + std::string(name) + "'", "one of: " + names);
}

PartsDesign make_parts_design(const PartsChoice& choice) {
  const PartsKind& kind = parts_kind(choice.kind);
  Random random = random_of(choice, choice.poses == PoseFamily::FLUSH ? 1 : 0);
  const auto part = [&](std::string_view name) {
    if (name == POLYCUBE) return random_polycube(random);
    if (name == STAR_PRISM) return random_star_prism(random);
    if (name == ANY_FORMED) return formed_shapes()[random.index(formed_shapes().size())].make(random);
    for (const FormedShape& shape : formed_shapes())
      if (name == shape.name) return shape.make(random);
    if (const auto clear = clear_shapes().find(name); clear != clear_shapes().end()) return clear->second;
    return name.empty() ? machine_parts()[random.index(machine_parts().size())].mesh : machine_part(name);
  };
  PartsDesign design;
  if (std::string_view(kind.fixed) == ITS_MATE) {
    Mates mates = std::string_view(kind.moving) == TURNED_MATES ? random_turned_mates(random)
                                                                : random_relief_mates(random);
    design = {std::move(mates.inner), std::move(mates.outer), {}};
  } else {
    design.moving = part(kind.moving);
    design.fixed = std::string_view(kind.fixed) == ITS_COPY ? design.moving : part(kind.fixed);
  }
  const Generator generator = family_of(kind).generator;
  if (!kind.nested && generator != Generator::FORMED_SHAPES) {
    design.moving = on_some_side(std::move(design.moving), random);
    design.fixed = on_some_side(std::move(design.fixed), random);
  }
  const PoseMaker maker(design, kind.nested, generator, choice.poses);
  const bool slides = choice.poses == PoseFamily::ANY && chance(0.5, random);
  const double step = std::pow(10.0, random.uniform(-6.0, -2.0));
  const Vec3 way = step * level_direction(random);
  const Eigen::Quaterniond turn = about_z(tiny(0.5, std::log10(step) - 2.0, std::log10(step), random));
  design.poses = poses_of(POSES_A_SCENE, slides, way, turn, [&] { return maker.unrelated(random); });
  return design;
}

PartsScene make_parts_scene(const PartsChoice& choice) {
  PartsDesign design = make_parts_design(choice);
  Random random = random_of(choice, 2 + static_cast<std::uint64_t>(choice.coordinates));
  PartsScene result;
  result.diagonal = bounding_box_diagonal(design.fixed);
  const File moving = file_of("moving", std::move(design.moving), choice.coordinates, random);
  const File fixed = file_of("fixed", std::move(design.fixed), choice.coordinates, random);
  result.scene = {moving.body, {fixed.body}, CUTOFF};
  const bool moved = choice.coordinates == Coordinates::TURNED || choice.coordinates == Coordinates::ROUNDED;
  for (const Pose& X_DA : design.poses)
    result.poses.push_back(moved ? fixed.X_FD * X_DA * moving.X_FD.inverse() : X_DA);
  return result;
}

}  // namespace lmdbench::parts
