#include "engine/base/report.h"

#include <algorithm>
#include <ostream>

namespace lightwell {

std::string to_string(Finding finding)
{
    switch (finding) {
    case Finding::assumed:
        return "assumed";
    case Finding::repaired:
        return "repaired";
    case Finding::approximated:
        return "approximated";
    case Finding::ignored:
        return "ignored";
    case Finding::unsupported:
        return "not modelled";
    case Finding::unmapped:
        return "unmapped";
    case Finding::unused:
        return "unused";
    case Finding::converted:
        return "converted";
    case Finding::question:
        return "question";
    }
    return "note";
}

void Report::add(Finding finding, const std::string& place, const std::string& text, std::size_t count)
{
    const auto [entry, fresh] = index_.try_emplace({finding, text}, notes_.size());
    if (fresh)
        notes_.push_back({finding, place, text, count});
    else
        notes_[entry->second].count += count;
}

void Report::add(const Report& other)
{
    for (const Note& note : other.notes())
        add(note.finding, note.place, note.text, note.count);
}

bool Report::has(Finding finding) const
{
    return std::any_of(notes_.begin(), notes_.end(), [&](const Note& note) { return note.finding == finding; });
}

std::ostream& operator<<(std::ostream& out, const Report& report)
{
    for (const Note& note : report.notes()) {
        out << note.place << ": " << to_string(note.finding) << ": " << note.text;
        if (note.count > 1)
            out << " (" << note.count << " times)";
        out << '\n';
    }
    return out;
}

void Ledger::made(const std::string& type, const std::string& layer, std::size_t count)
{
    if (count == 0)
        return;
    made_[{type, layer, {}}] += count;
    made_count_ += count;
}

void Ledger::skipped(const std::string& type, const std::string& layer, const std::string& reason, std::size_t count)
{
    skipped_[{type, layer, reason}] += count;
}

void Ledger::repaired(const std::string& type, const std::string& layer, const std::string& what, std::size_t count)
{
    repaired_[{type, layer, what}] += count;
}

void Ledger::unmake(const std::string& type, const std::string& layer, const std::string& reason, std::size_t count,
                    const std::string& made_on)
{
    const auto take = [&](const Key& key) {
        const auto entry = made_.find(key);
        if (entry == made_.end())
            return false;
        entry->second -= std::min(entry->second, count);
        if (entry->second == 0)
            made_.erase(entry);
        return true;
    };
    if (!take({type, made_on.empty() ? layer : made_on, {}}))
        take({});
    made_count_ -= std::min(made_count_, count);
    skipped(type, layer, reason, count);
}

std::size_t Ledger::read_count() const
{
    std::size_t total = made_count_;
    for (const auto& entry : skipped_)
        total += entry.second;
    return total;
}

std::vector<Ledger::Made> Ledger::made_list() const
{
    std::vector<Made> list;
    for (const auto& [key, count] : made_)
        list.push_back({key.type, key.layer, count});
    return list;
}

std::vector<Ledger::Skipped> Ledger::skipped_list() const
{
    std::vector<Skipped> list;
    for (const auto& [key, count] : skipped_)
        list.push_back({key.type, key.layer, key.reason, count});
    return list;
}

std::vector<Ledger::Repaired> Ledger::repaired_list() const
{
    std::vector<Repaired> list;
    for (const auto& [key, count] : repaired_)
        list.push_back({key.type, key.layer, key.reason, count});
    return list;
}

void Ledger::add(const Ledger& other)
{
    made_count_ += other.made_count_;
    for (const auto& [mine, theirs] : {std::pair{&made_, &other.made_}, std::pair{&skipped_, &other.skipped_},
                                       std::pair{&repaired_, &other.repaired_}})
        for (const auto& [key, count] : *theirs)
            (*mine)[key] += count;
}

} // namespace lightwell
