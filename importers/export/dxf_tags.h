#pragma once

#include "engine/base/vector.h"

#include <cstdint>
#include <string>

namespace lightwell {

/// Text of a DXF file: group codes and values, handles counted.
class DxfTags {
public:
    void tag(int code, const std::string& value);
    void tag(int code, const char* value) { tag(code, std::string(value)); }
    void tag(int code, std::int64_t value) { tag(code, std::to_string(value)); }
    void tag(int code, int value) { tag(code, std::to_string(value)); }
    /// The shortest text that reads back to the same number.
    void number(int code, double value);
    /// Three numbers with the codes `code`, `code` + 10, `code` + 20.
    void point(int code, const Point& point);
    /// A name: control characters escaped, never empty.
    void name(int code, const std::string& text);
    /// Begins an object of a type with a handle of its own, which is returned.
    std::string begin(const std::string& type, const std::string& owner);
    /// A handle that nothing else has.
    std::string take_handle();
    /// Forgets what was written, but not which handles are taken.
    void clear_text() { text_.clear(); }
    const std::string& text() const { return text_; }
    /// The next handle that will be given out.
    std::string next_handle() const;

private:
    std::string text_;
    std::uint64_t handles_ = 0x30; ///< lower ones are spoken for by the tables
};

} // namespace lightwell
