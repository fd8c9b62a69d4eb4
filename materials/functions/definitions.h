#pragma once

#include "materials/functions/expression.h"

#include <map>
#include <memory>

namespace lightwell {

/// The names that function files define, each within the context of its file.
///
/// A file's context is its name: what it defines hides what others define, for itself alone. Within context `a` the
/// name `x` means its own x, else the one known everywhere; `` `x `` only its own, `` x` `` only the one known
/// everywhere, and `` x`b `` that of context b.
class Definitions {
public:
    /// Definitions of the same name replace earlier ones.
    /// @param file     for messages
    /// @param context  empty: known everywhere
    /// @throws InputError with file and line for a syntax error
    void add(std::string_view text, const std::string& file, const std::string& context = {});
    /// What a name means within a context; nullptr when it is not defined. Valid until the name is defined again.
    const Definition* find(const std::string& name, const std::string& context) const;

private:
    std::map<std::string, std::shared_ptr<const Definition>, std::less<>> by_name_; ///< name and context together
};

/// What every function file knows beside its own definitions: the names of the place that is lit, and the helpers of
/// materials/functions/library/rayinit.cal.
/// @param of_material  also the bent normal and the colour below (`NxP`, `CrP`), which only materials may ask for
Definitions standard_definitions(bool of_material = false);

/// The text of a standard function file (`source.cal`), nullptr when there is none of that name.
const std::string_view* standard_function_file(std::string_view name);

} // namespace lightwell
