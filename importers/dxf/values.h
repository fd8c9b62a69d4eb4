#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace lightwell::dxf {

/// A number of an entity with its group code. In a POLYLINE each VERTEX begins with code 0, whose number is the
/// place of the vertex in the file.
struct Value {
    int code;
    double number;
};
inline constexpr int vertex_begins = 0;

/// The numbers of one entity, in the order of the file.
using Values = std::span<const Value>;

/// The numbers of all entities, those of one entity side by side. It grows in pieces that stay where they are, so that
/// a large drawing is never copied while it is read.
class ValueStore {
public:
    /// Begins an entity, or begins it anew.
    void begin() { begin_ = end_; }
    void drop() { end_ = begin_; }
    void add(const Value& value)
    {
        if (end_ == limit_)
            grow();
        *end_++ = value;
    }
    /// The numbers since begin(); they stay valid as long as the store, or the one that takes them over.
    Values taken() const { return {begin_, end_}; }
    /// Keeps the numbers of another drawing alive with these.
    void take_over(ValueStore&& other)
    {
        for (auto& piece : other.pieces_)
            pieces_.push_back(std::move(piece));
        other = {};
    }

private:
    void grow()
    {
        constexpr std::size_t usual = 1 << 16; // a megabyte
        const auto begun = static_cast<std::size_t>(end_ - begin_);
        const std::size_t size = std::max(usual, 2 * begun);
        std::unique_ptr<Value[]> piece{new Value[size]}; // not set to zero: only what is used costs memory
        std::copy(begin_, end_, piece.get());
        begin_ = piece.get();
        end_ = begin_ + begun;
        limit_ = begin_ + size;
        pieces_.push_back(std::move(piece));
    }

    std::vector<std::unique_ptr<Value[]>> pieces_;
    Value* begin_ = nullptr;
    Value* end_ = nullptr;
    Value* limit_ = nullptr;
};

} // namespace lightwell::dxf
