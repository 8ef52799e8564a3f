// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Whether a sanitizer watches this build: it takes time, reserves terabytes of address space, and
/// ends a process before its memory is damaged.
namespace lmdbench {

// Of clang alone: other libraries define __has_feature as 0 where a compiler has none.
#ifdef __clang__
inline constexpr bool ADDRESS_SANITIZER = __has_feature(address_sanitizer);
inline constexpr bool THREAD_SANITIZER = __has_feature(thread_sanitizer);
#else
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool ADDRESS_SANITIZER = true;
#else
inline constexpr bool ADDRESS_SANITIZER = false;
#endif
#ifdef __SANITIZE_THREAD__
inline constexpr bool THREAD_SANITIZER = true;
#else
inline constexpr bool THREAD_SANITIZER = false;
#endif
#endif
inline constexpr bool IS_SANITIZED = ADDRESS_SANITIZER || THREAD_SANITIZER;

}  // namespace lmdbench
