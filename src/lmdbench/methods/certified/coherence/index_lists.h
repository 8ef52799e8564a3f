// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// A fixed number of lists of indices; every index is in one of them or in none. Moving one costs the same
/// however long the lists are, and nothing is allocated for it.
class IndexLists {
 public:
  explicit IndexLists(std::uint32_t list_count) : list_count_(list_count) { clear(); }

  /// Forgets all indices.
  void clear() {
    links_.resize(list_count_);
    for (std::uint32_t i = 0; i < list_count_; ++i) links_[i] = {i, i};
  }
  /// Adds the next index, in no list.
  void add() {
    const auto link = static_cast<std::uint32_t>(links_.size());
    links_.push_back({link, link});
  }
  /// Moves an index to the front of a list.
  void move_to(std::uint32_t index, std::uint32_t list) {
    LMDBENCH_EXPECTS(list < list_count_ && index + list_count_ < links_.size(),
                     "an index that was never added");
    remove(index);
    const std::uint32_t link = index + list_count_, after = links_[list].next;
    links_[link] = {after, list};
    links_[after].previous = link;
    links_[list].next = link;
  }
  void remove(std::uint32_t index) {
    LMDBENCH_EXPECTS(index + list_count_ < links_.size(), "an index that was never added");
    const std::uint32_t link = index + list_count_;
    const Link old = links_[link];
    links_[old.next].previous = old.previous;
    links_[old.previous].next = old.next;
    links_[link] = {link, link};
  }
  bool empty(std::uint32_t list) const { return links_[list].next == list; }
  /// Calls visit(index) for every index of a list; it may move or remove that index.
  template <class Visit>
  void for_each(std::uint32_t list, Visit&& visit) const {
    for (std::uint32_t link = links_[list].next; link != list;) {
      const std::uint32_t next = links_[link].next;
      visit(link - list_count_);
      link = next;
    }
  }

 private:
  /// Circular lists; the first links are their heads.
  struct Link {
    std::uint32_t next, previous;
  };
  std::uint32_t list_count_;
  std::vector<Link> links_;
};

}  // namespace lmdbench
