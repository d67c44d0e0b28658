/// A case file as a tree of values that know where they stand, with its base file and its materials laid underneath.
#pragma once

#include "scene/case.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cupel
{

/// Where a key or a value stands. For an override the file is "--set" and the line its number.
struct Position
{
    std::shared_ptr<const std::string> file;
    unsigned line = 1;
    unsigned column = 1;
};

/// "FILE:LINE:COLUMN"
std::string position_text(const Position& position);

/// Throws CaseError "FILE:LINE:COLUMN: key: what; remedy". The remedy may end in a suggestion().
[[noreturn]] void refuse(const Position& position, const std::string& key, const std::string& what,
                         const std::string& remedy);

/// A value of a TOML file.
struct Node
{
    enum class Kind { table, array, text, integer, number, boolean };

    Kind kind = Kind::table;
    Position key_position; ///< of the key that names it; of the value where it has none
    Position position;     ///< of the value
    std::map<std::string, Node> members;
    std::vector<Node> items;
    std::string text;
    std::int64_t integer = 0;
    double number = 0;
    bool boolean = false;

    bool is(Kind other) const { return kind == other; }
    bool is_numeric() const { return is(Kind::integer) || is(Kind::number); }
    double numeric() const { return is(Kind::integer) ? static_cast<double>(integer) : number; }
    /// The member of a table, or nullptr.
    const Node* find(const std::string& key) const;
};

/// "a table", "a text", ... for messages.
std::string kind_text(const Node& node);

/// One TOML file. Throws CaseError with the position where it is no TOML, or when the file cannot be read.
Node read_toml(const std::string& path);

/// Lays `over` on `under`: tables merge key by key, a table whose keys are numbers lies over the items of a list,
/// everything else is replaced. Throws CaseError where a number is no place in the list.
void merge(Node& under, Node over);

/// Names of the variations of a case file, [sweep.NAME], in the order in which they stand; none for a single case.
/// Throws CaseError.
std::vector<std::string> variation_names(const std::string& path);

/// A case file with what `base` names underneath it, the table [sweep.VARIATION] on top of it, overrides
/// "key.path=value" on top of that, and every material's `use` taken from the materials folder. `variation` is empty
/// for a file without [sweep]. The keys `base`, `sweep` and `use` are consumed. Throws CaseError.
Node read_document(const std::string& path, const std::string& variation, const std::vector<std::string>& overrides);

} // namespace cupel
