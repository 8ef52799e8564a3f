// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmarks/every_frame.h>

#include <utility>

namespace lmdbench::experiments {
namespace {

class SearchEveryFrame : public FrameLoop {
 public:
  SearchEveryFrame(std::unique_ptr<GlobalSearch> search, const RecordedPath& path)
      : path_(path), search_(std::move(search)) {}

  void step(std::size_t frame) override { search_->run(path_.poses()[frame]); }
  double minimum_distance() const override { return search_->minimum_distance(); }
  const LmdSet* lmds() const override { return search_->lmds(); }

 private:
  const RecordedPath& path_;
  std::unique_ptr<GlobalSearch> search_;
};

}  // namespace

std::unique_ptr<FrameLoop> make_search_every_frame(const SearchImplementation& search,
                                                   const RecordedPath& path) {
  return std::make_unique<SearchEveryFrame>(search.make(path.scene), path);
}

}  // namespace lmdbench::experiments
