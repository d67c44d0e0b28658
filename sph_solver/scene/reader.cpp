#include "scene/reader.hpp"

#include "scene/convert.hpp"
#include "scene/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace cupel
{

namespace
{

using nlohmann::json;

std::vector<std::string> keys_of(const Table& table)
{
    std::vector<std::string> keys;
    for (const Parameter& parameter : table.parameters)
        keys.push_back(parameter.key);
    for (const Table& inner : table.tables)
        keys.push_back(inner.key);
    return keys;
}

void check_keys(const Table& table, const Node& node, const std::string& path);

void check_keys_by_occurrence(const Table& table, const Node& node, const std::string& path)
{
    switch (table.occurrence) {
    case Table::Occurrence::once:
        check_keys(table, node, path);
        break;
    case Table::Occurrence::named:
        require_kind(node, Node::Kind::table, path, "write [" + path + ".NAME]");
        for (const auto& [name, member] : node.members)
            check_keys(table, member, below(path, name));
        break;
    case Table::Occurrence::listed:
        require_kind(node, Node::Kind::array, path, "write [[" + path + "]]");
        for (std::size_t index = 0; index < node.items.size(); ++index)
            check_keys(table, node.items[index], below(path, std::to_string(index)));
        break;
    }
}

void check_keys(const Table& table, const Node& node, const std::string& path)
{
    require_kind(node, Node::Kind::table, path, "write it as a table [" + path + "]");
    const std::vector<std::string> known = keys_of(table);
    for (const auto& [key, member] : node.members) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            const std::string near = suggestion(key, known);
            refuse(member.key_position, below(path, key), "unknown key",
                   near.empty() ? "take it out or use one of: " + joined(known) : "correct it" + near);
        }
        for (const Table& inner : table.tables)
            if (inner.key == key) check_keys_by_occurrence(inner, member, below(path, key));
    }
}

Node empty_table(const Position& position)
{
    Node node;
    node.position = position;
    node.key_position = position;
    return node;
}

class Reader
{
public:
    Reading reading{json::object(), json::array(), json::array()};

    json read_table(const Table& table, const Node& node, const std::string& path)
    {
        json values = json::object();
        for (const Parameter& parameter : table.parameters) {
            if (applies(parameter, node.find(parameter.key), values, path))
                read_parameter(parameter, node, path, values);
        }
        for (const Table& inner : table.tables) {
            const Node* found = node.find(inner.key);
            if (!applies(inner, found, values, path)) continue;
            if (found)
                values[inner.key] = read_occurrences(inner, *found, below(path, inner.key));
            else if (inner.required)
                refuse(node.position, below(path, inner.key), "is missing", "add it: " + inner.help);
            else if (inner.filled)
                values[inner.key] = read_table(inner, empty_table(node.position), below(path, inner.key));
        }
        return values;
    }

private:
    json read_occurrences(const Table& table, const Node& node, const std::string& path)
    {
        if (table.occurrence == Table::Occurrence::once) return read_table(table, node, path);
        json values = table.occurrence == Table::Occurrence::named ? json::object() : json::array();
        for (const auto& [name, member] : node.members)
            values[name] = read_table(table, member, below(path, name));
        for (std::size_t index = 0; index < node.items.size(); ++index)
            values.push_back(read_table(table, node.items[index], below(path, std::to_string(index))));
        return values;
    }

    /// Whether a parameter or table goes with what stands beside it; refuses one that is there and does not.
    template <typename Declared>
    static bool applies(const Declared& declared, const Node* found, const json& values, const std::string& path)
    {
        if (declared.only_with.empty() || !values.contains(declared.only_with)) return true;
        const std::string deciding = values.at(declared.only_with);
        const auto& allowed = declared.only_values;
        if (std::find(allowed.begin(), allowed.end(), deciding) != allowed.end()) return true;
        if (found)
            refuse(found->key_position, below(path, declared.key),
                   "has no meaning with " + declared.only_with + " = \"" + deciding + "\"",
                   "take it out, it goes with " + joined(allowed));
        return false;
    }

    void read_parameter(const Parameter& parameter, const Node& table, const std::string& path, json& values)
    {
        const std::string full_key = below(path, parameter.key);
        const Node* node = table.find(parameter.key);
        if (!node) {
            if (parameter.required)
                refuse(table.position, full_key, "is missing",
                       "add it: " + parameter.help + ", " + value_hint(parameter));
            const bool paper = parameter.paper_fallback && values.value("formulation", "") == "paper";
            if (paper)
                values[parameter.key] = *parameter.paper_fallback;
            else if (parameter.fallback)
                values[parameter.key] = *parameter.fallback;
            return;
        }
        const bool levels = parameter.type == Type::by_level && !node->find("value");
        if (node->is(Node::Kind::table) && !levels)
            values[parameter.key] = annotated(parameter, *node, full_key);
        else
            values[parameter.key] = convert_value(parameter, *node, full_key);
    }

    /// { value = ..., assumed = "reason" } or { value = ..., source = "where from" }.
    json annotated(const Parameter& parameter, const Node& node, const std::string& path)
    {
        static const std::vector<std::string> known{"value", "assumed", "source"};
        for (const auto& [key, member] : node.members)
            if (std::find(known.begin(), known.end(), key) == known.end())
                refuse(member.key_position, below(path, key), "unknown key",
                       "a value with a note is { value = ..., assumed = \"reason\" } or { value = ..., source = "
                       "\"...\" }" +
                           suggestion(key, known));
        const Node* value = node.find("value");
        if (!value) refuse(node.position, path, "has no value", "write { value = ..., assumed = \"reason\" }");
        const json converted = convert_value(parameter, *value, path);
        for (const char* note : {"assumed", "source"}) {
            const Node* text = node.find(note);
            if (!text) continue;
            require_kind(*text, Node::Kind::text, below(path, note), "write the reason as a text in quotes");
            if (std::string(note) == "assumed")
                reading.assumed.push_back(
                    {{"key", path}, {"value", converted}, {"unit", parameter.unit}, {"reason", text->text}});
            else
                reading.sources.push_back({{"key", path}, {"source", text->text}});
        }
        return converted;
    }
};

} // namespace

Reading read_declared(const Table& declaration, const Node& document)
{
    check_keys(declaration, document, "");
    Reader reader;
    reader.reading.values = reader.read_table(declaration, document, "");
    return reader.reading;
}

const Node& node_at(const Node& document, const std::string& path)
{
    const Node* node = &document;
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, '.');) {
        const Node* next = nullptr;
        if (node->is(Node::Kind::table))
            next = node->find(part);
        else if (node->is(Node::Kind::array) && std::all_of(part.begin(), part.end(), ::isdigit) &&
                 std::stoul(part) < node->items.size())
            next = &node->items[std::stoul(part)];
        if (!next) break;
        node = next;
    }
    return *node;
}

} // namespace cupel
