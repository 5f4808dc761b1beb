#include "mpm/wave.hpp"

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace vitrum::mpm {
namespace {

/// Pieces of a line whose stage may be taken.
struct Ready {
  std::size_t stage, line, next, end;
};
struct Piece {
  std::size_t stage, line, piece;
};

/// What one thread has made ready. It goes on with the newest; others help with the oldest.
class alignas(64) ReadyPieces {
 public:
  void add(const Ready& ready) {
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) ready_.clear(), first_ = 0;
    ready_.push_back(ready);
    some_.store(true, std::memory_order_relaxed);
  }
  std::optional<Piece> newest() {
    return take([this]() -> Ready& { return ready_.back(); }, [this] { ready_.pop_back(); });
  }
  std::optional<Piece> oldest() {
    return take([this]() -> Ready& { return ready_[first_]; }, [this] { ++first_; });
  }
  void clear() {
    ready_.clear(), first_ = 0;
    some_ = false;
  }

 private:
  template <class Which, class Drop>
  std::optional<Piece> take(Which&& which, Drop&& drop) {
    if (!some_.load(std::memory_order_relaxed)) return {};  // (a look, not a promise)
    const std::lock_guard lock(mutex_);
    if (first_ == ready_.size()) return {};
    Ready& ready = which();
    const Piece piece{ready.stage, ready.line, ready.next++};
    if (ready.next == ready.end) drop();
    some_.store(first_ != ready_.size(), std::memory_order_relaxed);
    return piece;
  }

  std::mutex mutex_;
  std::vector<Ready> ready_;  // from first_ on
  std::size_t first_ = 0;
  std::atomic<bool> some_{false};
};

/// The pieces whose first stage one thread begins with.
struct alignas(64) Share {
  std::atomic<std::size_t> next{0};
  std::size_t end = 0;
};

}  // namespace

struct Wave::Shared {
  std::span<const std::size_t> lines;
  std::size_t count = 0, stages = 0;
  Call call = nullptr;
  void* context = nullptr;
  std::vector<std::size_t> line_of;                 // by piece
  std::vector<std::atomic<std::uint32_t>> awaited;  // by stage and line: pieces that must be done before
  std::vector<ReadyPieces> ready;                   // by thread
  std::vector<Share> shares;                        // by thread
  std::atomic<std::size_t> left{0};                 // pieces whose last stage is not over
  std::atomic<bool> stopped{false};

  void prepare(std::size_t threads);
  void work(std::size_t thread);
  std::optional<Piece> next(std::size_t thread);
  std::optional<Piece> next_of_share(std::size_t thread);
  void finish(const Piece& piece, std::size_t thread);
};

Wave::Wave() = default;
Wave::~Wave() = default;
Wave::Wave(Wave&&) noexcept = default;
Wave& Wave::operator=(Wave&&) noexcept = default;

void Wave::Shared::prepare(std::size_t threads) {
  const std::size_t pieces = lines[count];
  line_of.resize(pieces);
  for (std::size_t line = 0; line < count; ++line)
    for (std::size_t piece = lines[line]; piece < lines[line + 1]; ++piece) line_of[piece] = line;
  if (awaited.size() < stages * count) awaited = std::vector<std::atomic<std::uint32_t>>(stages * count);
  for (std::size_t stage = 1; stage < stages; ++stage)
    for (std::size_t line = 0; line < count; ++line) {
      const std::size_t first = line == 0 ? 0 : line - 1, last = line + 1 == count ? line : line + 1;
      awaited[stage * count + line].store(static_cast<std::uint32_t>(lines[last + 1] - lines[first]),
                                          std::memory_order_relaxed);
    }
  if (ready.size() != threads || shares.size() != threads) {
    ready = std::vector<ReadyPieces>(threads);
    shares = std::vector<Share>(threads);
  }
  for (ReadyPieces& own : ready) own.clear();  // (an exception may have left some)
  for (std::size_t n = 0; n < threads; ++n) {
    shares[n].next = pieces * n / threads;
    shares[n].end = pieces * (n + 1) / threads;
  }
  left = pieces;
  stopped = false;
}

/// A piece of the share that a thread began with.
std::optional<Piece> Wave::Shared::next_of_share(std::size_t thread) {
  Share& share = shares[thread];
  if (share.next.load(std::memory_order_relaxed) >= share.end) return {};
  const std::size_t piece = share.next.fetch_add(1, std::memory_order_relaxed);
  if (piece >= share.end) return {};
  return Piece{0, line_of[piece], piece};
}

/// First what this thread has at hand, then what others have not come to.
std::optional<Piece> Wave::Shared::next(std::size_t thread) {
  if (auto piece = ready[thread].newest()) return piece;
  if (auto piece = next_of_share(thread)) return piece;
  for (std::size_t k = 1; k < ready.size(); ++k)
    if (auto piece = ready[(thread + k) % ready.size()].oldest()) return piece;
  for (std::size_t k = 1; k < ready.size(); ++k)
    if (auto piece = next_of_share((thread + k) % ready.size())) return piece;
  return {};
}

/// Makes ready what has waited for the piece as the last one.
void Wave::Shared::finish(const Piece& done, std::size_t thread) {
  const std::size_t stage = done.stage + 1;
  if (stage == stages) {
    left.fetch_sub(1, std::memory_order_acq_rel);
    return;
  }
  const std::size_t first = done.line == 0 ? 0 : done.line - 1;
  const std::size_t last = done.line + 1 == count ? done.line : done.line + 1;
  for (std::size_t line = first; line <= last; ++line)
    if (awaited[stage * count + line].fetch_sub(1, std::memory_order_acq_rel) == 1)
      ready[thread].add({stage, line, lines[line], lines[line + 1]});
}

void Wave::Shared::work(std::size_t thread) {
  constexpr int patience = 2000;  // looks before another process may have the processor
  int looks = 0;
  while (left.load(std::memory_order_acquire) != 0 && !stopped.load(std::memory_order_relaxed)) {
    const std::optional<Piece> piece = next(thread);
    if (!piece) {
      if (++looks > patience) std::this_thread::yield();
      continue;
    }
    looks = 0;
    try {
      call(context, piece->stage, piece->piece);
      finish(*piece, thread);  // which may want memory
    } catch (...) {
      stopped = true;
      throw;
    }
  }
}

void Wave::run_together(ThreadTeam& team, std::span<const std::size_t> lines, std::size_t stages, Call call,
                        void* context) {
  if (stages == 0) return;
  if (!shared_) shared_ = std::make_unique<Shared>();
  Shared& shared = *shared_;
  shared.lines = lines, shared.count = lines.size() - 1, shared.stages = stages;
  shared.call = call, shared.context = context;
  shared.prepare(static_cast<std::size_t>(team.size()));
  team.on_each_thread([&shared](std::size_t thread) { shared.work(thread); });
}

}  // namespace vitrum::mpm
