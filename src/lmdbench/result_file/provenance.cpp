// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/result_file/provenance.h>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/personality.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace lmdbench {
namespace {

/// "2026-11-20T04:15:00Z": ISO 8601, whole seconds.
std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

void write_inputs(ResultWriter& writer, const std::vector<InputFile>& inputs) {
  std::vector<std::string> roles;
  std::vector<std::string> files;
  std::vector<std::string> hashes;
  std::vector<std::int64_t> sizes;
  for (const InputFile& input : inputs) {
    roles.push_back(input.role);
    files.push_back(input.file.generic_string());
    hashes.push_back(input.sha256);
    sizes.push_back(input.size);
  }
  writer.write({"/provenance/inputs/role", "1", "what the file is to the experiment"}, roles);
  writer.write({"/provenance/inputs/file", "1", "path of the file as the run named it"}, files);
  writer.write({"/provenance/inputs/sha256", "1", "SHA-256 of the bytes that were read"}, hashes);
  writer.write({"/provenance/inputs/size", "byte", "length of the file"}, sizes, {sizes.size()});
}

}  // namespace

void write_provenance(ResultWriter& writer, const std::vector<std::string>& argv,
                      const std::string& experiment_json, const std::string& plan_json,
                      const std::vector<InputFile>& inputs,
                      const std::vector<std::pair<std::string, std::string>>& machine) {
  const BuildInfo& build = build_info();
  writer.attribute("/", "format", RESULT_FORMAT);
  writer.attribute("/", "format_version", std::int64_t{RESULT_FORMAT_VERSION});
  writer.attribute("/", "creator", "lmdbench " + build.version);
  writer.attribute("/", "created_utc", utc_now());

  const std::string group = "/provenance";
  writer.attribute(group, "program_version", build.version);
  writer.attribute(group, "git_commit", build.git_commit);
  writer.attribute(group, "git_dirty", build.git_dirty);
  writer.attribute(group, "compiler", build.compiler);
  writer.attribute(group, "compiler_flags", build.compiler_flags);
  writer.attribute(group, "build_type", build.build_type);
  writer.attribute(group, "target", build.target);
  for (const auto& [name, version] : build.libraries) writer.attribute(group + "/libraries", name, version);
  for (const auto& [name, value] : machine) writer.attribute(group + "/machine", name, value);

  writer.write({group + "/argv", "1", "command line of the run, argument by argument"}, argv);
  writer.write({group + "/experiment", "1", "the experiment with every default filled in, JSON"},
               {experiment_json});
  writer.write({group + "/plan", "1", "what the run did and left out, JSON"}, {plan_json});
  write_inputs(writer, inputs);
}

namespace {

constexpr const char* UNKNOWN = "unknown";

std::string or_unknown(const std::string& text) {
  return text.empty() ? UNKNOWN : text;
}

/// First line of a file of /proc or /sys, "unknown" where there is none.
std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return or_unknown(line);
}

std::string trimmed(const std::string& text) {
  constexpr const char* BLANK = " \t\"";
  const std::size_t first = text.find_first_not_of(BLANK);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(BLANK) - first + 1);
}

/// The keys of a "key <separator> value" file; of repeated keys the first.
std::map<std::string, std::string> key_values(const std::string& file, char separator) {
  std::map<std::string, std::string> pairs;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t end = line.find(separator);
    if (end != std::string::npos) pairs.emplace(trimmed(line.substr(0, end)), trimmed(line.substr(end + 1)));
  }
  return pairs;
}

/// Values of a file of every processor, as governors: "performance" or "powersave, performance".
std::string per_processor(const std::string& file) {
  std::set<std::string> values;
  const long count = ::sysconf(_SC_NPROCESSORS_CONF);
  for (long i = 0; i < count; ++i) {
    std::ifstream stream(fmt::format("/sys/devices/system/cpu/cpu{}/{}", i, file));
    std::string line;
    if (std::getline(stream, line)) values.insert(line);
  }
  std::string joined;
  for (const std::string& value : values) joined += (joined.empty() ? "" : ", ") + value;
  return or_unknown(joined);
}

std::string physical_cores() {
  std::set<std::string> cores;
  const long count = ::sysconf(_SC_NPROCESSORS_CONF);
  for (long i = 0; i < count; ++i) {
    const std::string siblings =
        first_line(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", i));
    if (siblings != UNKNOWN) cores.insert(siblings);
  }
  return cores.empty() ? UNKNOWN : std::to_string(cores.size());
}

std::string usable_processors() {
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return UNKNOWN;
  return std::to_string(CPU_COUNT(&set));
}

std::string cache_bytes(int name) {
  const long bytes = ::sysconf(name);
  return bytes > 0 ? std::to_string(bytes) : UNKNOWN;
}

std::string memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGE_SIZE);
  return pages > 0 && page > 0 ? std::to_string(static_cast<long long>(pages) * page) : UNKNOWN;
}

/// Frequency boost: one switch of AMD and acpi-cpufreq, and Intel's, which has the opposite sense.
std::string boost() {
  if (const std::string on = first_line("/sys/devices/system/cpu/cpufreq/boost"); on != UNKNOWN) {
    return on == "1" ? "on" : "off";
  }
  if (const std::string off = first_line("/sys/devices/system/cpu/intel_pstate/no_turbo"); off != UNKNOWN) {
    return off == "0" ? "on" : "off";
  }
  return UNKNOWN;
}

std::string isolated_processors() {
  std::ifstream stream("/sys/devices/system/cpu/isolated");
  std::string list;
  if (!stream) return UNKNOWN;
  std::getline(stream, list);
  return list.empty() ? "none" : list;
}

/// Of this process: `setarch --addr-no-randomize` turns it off for one program.
std::string address_space_randomisation() {
  constexpr unsigned long ONLY_ASK = 0xffffffff;
  const int personality_now = ::personality(ONLY_ASK);
  if (personality_now >= 0 && (personality_now & ADDR_NO_RANDOMIZE) != 0) return "off";
  std::string value = first_line("/proc/sys/kernel/randomize_va_space");
  if (value == UNKNOWN) return value;
  return value == "0" ? "off" : "on";
}

std::string load_average() {
  double load = 0.0;
  return ::getloadavg(&load, 1) == 1 ? fmt::format("{:.2f}", load) : UNKNOWN;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_info() {
  const std::map<std::string, std::string> processor = key_values("/proc/cpuinfo", ':');
  const std::map<std::string, std::string> system = key_values("/etc/os-release", '=');
  auto value_of = [](const std::map<std::string, std::string>& pairs, const char* key) {
    const auto found = pairs.find(key);
    return found == pairs.end() ? std::string(UNKNOWN) : or_unknown(found->second);
  };
  std::istringstream flag_list(value_of(processor, "flags"));
  const std::set<std::string> flags{std::istream_iterator<std::string>(flag_list), {}};
  std::string simd;
  for (const char* flag : {"sse4_2", "avx", "avx2", "fma", "avx512f"}) {
    if (flags.count(flag) > 0) simd += fmt::format("{}{}", simd.empty() ? "" : " ", flag);
  }
  struct utsname kernel {};
  const bool named = ::uname(&kernel) == 0;

  return {
      {"processor", value_of(processor, "model name")},
      {"processor_family_model_stepping",
       fmt::format("{} {}/{}/{}", value_of(processor, "vendor_id"), value_of(processor, "cpu family"),
                   value_of(processor, "model"), value_of(processor, "stepping"))},
      {"logical_processors", std::to_string(::sysconf(_SC_NPROCESSORS_ONLN))},
      {"physical_cores", physical_cores()},
      {"usable_processors", usable_processors()},
      {"simd", or_unknown(simd)},
      {"virtual_machine",
       flags.count(UNKNOWN) > 0 ? UNKNOWN : (flags.count("hypervisor") > 0 ? "yes" : "no")},
      {"l1_data_cache_bytes", cache_bytes(_SC_LEVEL1_DCACHE_SIZE)},
      {"l2_cache_bytes", cache_bytes(_SC_LEVEL2_CACHE_SIZE)},
      {"l3_cache_bytes", cache_bytes(_SC_LEVEL3_CACHE_SIZE)},
      {"memory_bytes", memory_bytes()},
      {"frequency_governor", per_processor("cpufreq/scaling_governor")},
      {"frequency_boost", boost()},
      {"simultaneous_multithreading", first_line("/sys/devices/system/cpu/smt/control")},
      {"isolated_processors", isolated_processors()},
      {"address_space_randomisation", address_space_randomisation()},
      {"clock_source", first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource")},
      {"load_average_1_minute", load_average()},
      {"operating_system", value_of(system, "PRETTY_NAME")},
      {"kernel", named ? fmt::format("{} {} {}", kernel.sysname, kernel.release, kernel.machine) : UNKNOWN},
  };
}

std::string program_sha256() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  return sha256_of_text(std::string(std::istreambuf_iterator<char>(program), {}));
}

}  // namespace lmdbench
