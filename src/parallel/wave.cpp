#include "parallel/wave.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "parallel/workload.hpp"

namespace vitrum::parallel {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// By stage, the pieces around a line that must be done before; after the last stage, those before the line
/// is over. No two lines share a cache line.
struct alignas(64) Awaited {
  std::array<std::atomic<std::uint32_t>, Wave::most_stages + 1> pieces;
};

}  // namespace

struct Wave::Shared {
  std::span<const std::size_t> lines, shares;
  std::size_t count = 0, stages = 0, at_once = 0;
  bool bounded() const { return at_once < count; }
  Call call = nullptr;
  void* context = nullptr;
  std::vector<std::size_t> line_of;  // by piece
  std::vector<Awaited> awaited;      // by line
  std::vector<Workload> workloads;   // by thread
  std::vector<double> seconds;       // by thread, for its share
  std::atomic<bool> stopped{false};
  std::chrono::microseconds patience{0};  // awake
  Vigil vigil;

  void prepare(std::size_t threads);
  void work(std::size_t thread);
  void take(const Ready& pieces, std::size_t thread);
  bool help(std::size_t thread);
  bool some_are_ready() const;
  bool is_over() const;
  void finish(const Ready& pieces, std::size_t thread);
  void make_ready(std::size_t stage, std::size_t line);
  void add(std::size_t thread, std::size_t stage, std::size_t line);
  void begin_lines(std::size_t thread);
  std::size_t before(std::size_t line) const { return line == 0 ? 0 : line - 1; }
  std::size_t after(std::size_t line) const { return line + 1 == count ? line : line + 1; }
};

Wave::Wave() = default;
Wave::~Wave() = default;
Wave::Wave(Wave&&) noexcept = default;
Wave& Wave::operator=(Wave&&) noexcept = default;

void Wave::Shared::prepare(std::size_t threads) {
  line_of.resize(lines[count]);
  for (std::size_t line = 0; line < count; ++line)
    for (std::size_t piece = lines[line]; piece < lines[line + 1]; ++piece)
      if (line_of[piece] != line) line_of[piece] = line;  // (in the caches of all threads)
  if (awaited.size() < count) awaited = std::vector<Awaited>(count);
  for (std::size_t line = 0; line < count; ++line)
    for (std::size_t stage = 1; stage < stages + (bounded() ? 1 : 0); ++stage)
      awaited[line].pieces[stage].store(
          static_cast<std::uint32_t>(lines[after(line) + 1] - lines[before(line)]),
          std::memory_order_relaxed);
  if (workloads.size() != threads) workloads = std::vector<Workload>(threads);
  for (std::size_t n = 0; n < threads; ++n) {
    const bool some = shares[n] < shares[n + 1];
    workloads[n].start(n % 2 == 0, some ? line_of[shares[n]] : 0, some ? line_of[shares[n + 1] - 1] + 1 : 0);
    for (std::size_t k = 0; k < std::min(at_once, workloads[n].lines()); ++k) add(n, 0, workloads[n].line(k));
  }
  stopped = false;
}

void Wave::Shared::take(const Ready& pieces, std::size_t thread) {
  try {
    for (std::size_t piece = pieces.begin; piece < pieces.end; ++piece) call(context, pieces.stage, piece);
    finish(pieces, thread);  // which may want memory
    vigil.changed();
  } catch (...) {
    stopped = true;
    vigil.changed();
    throw;
  }
}

/// Takes what another thread has not come to, if there is any.
bool Wave::Shared::help(std::size_t thread) {
  for (std::size_t k = 1; k < workloads.size(); ++k) {
    Workload& other = workloads[(thread + k) % workloads.size()];
    const std::optional<Ready> pieces = other.oldest(line_of);
    if (!pieces) continue;
    const Clock::time_point start = Clock::now();
    take(*pieces, thread);
    other.count_seconds(seconds_since(start));
    return true;
  }
  return false;
}

bool Wave::Shared::some_are_ready() const {
  return std::ranges::any_of(workloads, &Workload::has_some);
}

bool Wave::Shared::is_over() const {
  std::size_t over = 0;
  for (const Workload& of_thread : workloads) over += of_thread.over();
  return over == lines[count];
}

/// Makes ready what has waited for the pieces, all of one line, as the last ones.
void Wave::Shared::finish(const Ready& done, std::size_t thread) {
  const std::size_t stage = done.stage + 1, of = line_of[done.begin];
  const auto size = static_cast<std::uint32_t>(done.end - done.begin);
  for (std::size_t line = before(of); line <= after(of) && (stage < stages || bounded()); ++line)
    if (awaited[line].pieces[stage].fetch_sub(size, std::memory_order_acq_rel) == size)
      make_ready(stage, line);
  if (stage == stages) workloads[thread].count_over(size);
}

/// Every piece goes to the thread whose share it is in: its data are in that thread's cache.
void Wave::Shared::make_ready(std::size_t stage, std::size_t line) {
  const auto first = std::upper_bound(shares.begin(), shares.end(), lines[line]) - shares.begin() - 1;
  for (auto n = static_cast<std::size_t>(first); n < workloads.size() && shares[n] < lines[line + 1]; ++n) {
    if (stage < stages)
      add(n, stage, line);
    else
      begin_lines(n);
  }
}

/// Makes a stage of a line ready, as far as that is in the thread's share.
void Wave::Shared::add(std::size_t thread, std::size_t stage, std::size_t line) {
  workloads[thread].add(
      {stage, std::max(lines[line], shares[thread]), std::min(lines[line + 1], shares[thread + 1])});
}

/// For every line that is over the thread may begin another one. In their order: where a neighbour is late, a
/// line may be over before those between them.
void Wave::Shared::begin_lines(std::size_t thread) {
  Workload& workload = workloads[thread];
  workload.for_lines_over(
      [&](std::size_t line) { return awaited[line].pieces[stages].load(std::memory_order_acquire) == 0; },
      [&](std::size_t n) {
        if (n + at_once < workload.lines()) add(thread, 0, workload.line(n + at_once));
      });
}

void Wave::Shared::work(std::size_t thread) {
  // Who helps at once pays more for a piece's data, which are in another cache, than is saved, and the thread
  // that owns them pays again; who never does leaves all to wait for one that is held up.
  constexpr std::chrono::microseconds before_help(15);
  constexpr unsigned looks_at_once = 64;  // some 5 ns each, a look at the clock takes longer
  Workload& own = workloads[thread];
  Clock::time_point since = Clock::now();  // the thread has been at its share, or has waited
  bool waits = false;
  for (unsigned looks = 0; !stopped.load(std::memory_order_relaxed);) {
    if (const std::optional<Ready> pieces = own.newest(line_of)) {
      if (waits) since = Clock::now();
      waits = false;
      take(*pieces, thread);
      continue;
    }
    if (!waits) {
      waits = true;
      const Clock::time_point now = Clock::now();
      own.count_seconds(std::chrono::duration<double>(now - since).count());
      since = now;
    }
    if (is_over()) return;
    if (++looks % looks_at_once != 0) continue;
    const Clock::duration waited = Clock::now() - since;
    if (waited < before_help || help(thread) || waited < patience) continue;
    // The last pieces lie with a thread that has lost the processor.
    vigil.sleep([this] { return stopped.load() || is_over() || some_are_ready(); });
  }
}

void Wave::run_together(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages,
                        std::size_t at_once, Call call, void* context) {
  if (stages > most_stages) throw std::logic_error("a wave has at most eight stages");
  if (at_once < fewest_at_once(stages)) throw std::logic_error("a wave must have more lines at once");
  if (shares_.bounds().size() != static_cast<std::size_t>(team.size()) + 1 ||
      shares_.bounds().back() != lines.back())
    throw std::logic_error("these lines have not been shared out to this team");
  if (stages == 0) return;
  if (!shared_) shared_ = std::make_unique<Shared>();
  Shared& shared = *shared_;
  shared.lines = lines, shared.shares = shares_.bounds(), shared.count = lines.size() - 1;
  shared.stages = stages, shared.at_once = std::min(at_once, shared.count);
  shared.call = call, shared.context = context;
  shared.patience = team.patience();
  shared.prepare(static_cast<std::size_t>(team.size()));
  team.on_each_thread([&shared](std::size_t thread) { shared.work(thread); });
  shared.seconds.clear();
  for (const Workload& workload : shared.workloads) shared.seconds.push_back(workload.seconds());
  shares_.learn(shared.seconds);
}

}  // namespace vitrum::parallel
