// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/method_summary.h>

#include <array>

namespace lmdbench {
namespace {

using M = MethodSummary;

constexpr std::array NUMBERS = {
    SummaryNumber{"frames_in_contact", "1", "frames in contact, at the poses that the method saw",
                  &M::frames_in_contact},
    SummaryNumber{"frames_touching", "1", "frames with an LMD at distance 0", &M::frames_touching},
    SummaryNumber{"lmd_count_median", "1", "LMDs in a frame in contact, median", &M::lmd_count_median},
    SummaryNumber{"lmd_count_p99", "1", "LMDs in a frame in contact, 99th percentile", &M::lmd_count_p99},
    SummaryNumber{"lmd_count_maximum", "1", "LMDs in a frame, most", &M::lmd_count_maximum},
    SummaryNumber{"candidates_median", "1", "candidates of a search in contact, median",
                  &M::candidates_median},
    SummaryNumber{"reduction_ratio", "1", "candidates of all searches / LMDs that all first reductions kept",
                  &M::reduction_ratio},
    SummaryNumber{"reduction_ratio_maximum", "1", "candidates / kept of one search, largest",
                  &M::reduction_ratio_maximum},
    SummaryNumber{"rendered_force_median_n", "N", "rendered force of a frame in contact, median",
                  &M::rendered_force_median_n},
    SummaryNumber{"rendered_force_p99_n", "N", "rendered force of a frame in contact, 99th percentile",
                  &M::rendered_force_p99_n},
    SummaryNumber{"rendered_force_maximum_n", "N", "rendered force of a frame in contact, largest",
                  &M::rendered_force_maximum_n},
    SummaryNumber{"force_clipped_share", "1", "frames in contact whose force was clipped / frames in contact",
                  &M::force_clipped_share},
    SummaryNumber{"force_above_30_hz_n", "N",
                  "rendered force behind a high pass at 30 Hz, root mean square over all frames",
                  &M::force_above_30_hz_n},
    SummaryNumber{"effective_stiffness_p99_n_per_m", "N/m", "K_eff of a frame in contact, 99th percentile",
                  &M::effective_stiffness_p99_n_per_m},
    SummaryNumber{
        "dropouts_per_second", "1/s",
        "frames in contact whose force has fallen to zero since the frame before, per second in contact",
        &M::dropouts_per_second},
    SummaryNumber{"energy_created_j", "J",
                  "closed loop: largest net work of the rendered force since the start",
                  &M::energy_created_j},
    SummaryNumber{"energy_balance_error", "1",
                  "closed loop: energy that the balance leaves over / energy that flowed, in the last frame",
                  &M::energy_balance_error},
    SummaryNumber{"recall", "1", "true LMDs found / true LMDs, all probed frames, same features", &M::recall},
    SummaryNumber{"recall_adjacent", "1", "the same, neighbouring features count", &M::recall_adjacent},
    SummaryNumber{"precision", "1",
                  "true ones of the method's LMDs / its LMDs, all probed frames, same features",
                  &M::precision},
    SummaryNumber{"precision_adjacent", "1", "the same, neighbouring features count", &M::precision_adjacent},
    SummaryNumber{"frames_wrong", "1", "probed frames in which the set is not the true one",
                  &M::frames_wrong},
    SummaryNumber{"minimum_distance_error_maximum_m", "m",
                  "minimum distance against the true one, largest error",
                  &M::minimum_distance_error_maximum_m},
    SummaryNumber{"force_error_rms_n", "N", "force error, root mean square", &M::force_error_rms_n},
    SummaryNumber{"force_error_median_n", "N", "force error, median", &M::force_error_median_n},
    SummaryNumber{"force_error_p99_n", "N", "force error, 99th percentile", &M::force_error_p99_n},
    SummaryNumber{"force_error_maximum_n", "N", "force error, largest", &M::force_error_maximum_n},
    SummaryNumber{"force_angle_error_median_rad", "rad", "angle to the true force, median",
                  &M::force_angle_error_median_rad},
    SummaryNumber{"force_jump_p99_n", "N",
                  "change of force to the next frame, probed frames, 99th percentile", &M::force_jump_p99_n},
    SummaryNumber{"force_jump_maximum_n", "N", "change of force to the next frame, probed frames, largest",
                  &M::force_jump_maximum_n},
    SummaryNumber{"true_force_jump_p99_n", "N", "the same of the true force, 99th percentile",
                  &M::true_force_jump_p99_n},
    SummaryNumber{"true_force_jump_maximum_n", "N", "the same of the true force, largest",
                  &M::true_force_jump_maximum_n},
    SummaryNumber{"jumps_per_second", "1/s",
                  "changes of force in a frame above 25 % of F_max, per second in contact",
                  &M::jumps_per_second},
    SummaryNumber{"true_jumps_per_second", "1/s",
                  "the same of the true force, estimated from the probed frames", &M::true_jumps_per_second},
    SummaryNumber{"local_update_median_s", "s", "local update of a frame in contact, median",
                  &M::local_update_median_s},
    SummaryNumber{"local_update_p99_s", "s", "local update of a frame in contact, 99th percentile",
                  &M::local_update_p99_s},
    SummaryNumber{"local_update_maximum_s", "s", "local update of a frame in contact, longest",
                  &M::local_update_maximum_s},
    SummaryNumber{"global_search_median_s", "s", "global search in contact, median",
                  &M::global_search_median_s},
    SummaryNumber{"global_search_p99_s", "s", "global search in contact, 99th percentile",
                  &M::global_search_p99_s},
    SummaryNumber{"first_reduction_median_s", "s", "first reduction of a search in contact, median",
                  &M::first_reduction_median_s},
    SummaryNumber{"second_tracking_median_s", "s", "second tracking of a search in contact, median",
                  &M::second_tracking_median_s},
    SummaryNumber{"search_with_reduction_median_s", "s",
                  "global search in contact with its first reduction, median",
                  &M::search_with_reduction_median_s},
    SummaryNumber{"search_with_reduction_p99_s", "s",
                  "global search in contact with its first reduction, 99th percentile",
                  &M::search_with_reduction_p99_s},
    SummaryNumber{"frame_time_median_s", "s",
                  "processor time of a frame in contact, its share of the searches in it, median",
                  &M::frame_time_median_s},
    SummaryNumber{"frame_time_p99_s", "s", "the same, 99th percentile", &M::frame_time_p99_s},
    SummaryNumber{"frame_time_maximum_s", "s", "the same, longest", &M::frame_time_maximum_s},
    SummaryNumber{"frames_late", "1", "frames in contact whose time is above 1 ms", &M::frames_late, true},
};

}  // namespace

std::span<const SummaryNumber> summary_numbers() {
  return NUMBERS;
}

}  // namespace lmdbench
