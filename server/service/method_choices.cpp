#include "server/service/method_choices.h"

#include <algorithm>

#include "protocol/message/limits.h"

namespace macula {

std::optional<Chosen> MethodChoices::ask(Choose choice) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() == kMostWaiting)
            return Chosen{choice.id, "too many choices wait: ask again when some have been answered"};
        waiting_.push_back(std::move(choice));
    }
    changed_.notify_one();
    return std::nullopt;
}

std::optional<Choose> MethodChoices::next(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    Choose choice = std::move(waiting_.front());
    waiting_.pop_front();
    return choice;
}

std::optional<Chosen> MethodChoices::make_next(std::chrono::milliseconds timeout) {
    const auto choice = next(timeout);
    if (!choice) return std::nullopt;
    auto method = find_or_make(choice->sampling);
    if (!method) return Chosen{choice->id, method.error().message.substr(0, kMaxText_bytes)};
    if (!choice->only_prepare) ready_.put({choice->id, *std::move(method)});
    return Chosen{choice->id, ""};
}

Expected<std::shared_ptr<MethodParts>> MethodChoices::find_or_make(const std::string& sampling) {
    const auto found = std::ranges::find(kept_, sampling, [](const auto& kept) { return kept.first; });
    if (found != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, found);
        return kept_.front().second;
    }
    auto made = make_(sampling);
    if (!made) return tl::unexpected(made.error());
    kept_.emplace_front(sampling, *std::move(made));
    if (kept_.size() > kMostKept) kept_.pop_back();
    return kept_.front().second;
}

void MethodChoices::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
}

}  // namespace macula
