#include "scene/document.hpp"

#include "scene/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <toml++/toml.h>

namespace cupel
{

namespace
{

namespace fs = std::filesystem;

using File = std::shared_ptr<const std::string>;

Position position_of(const File& file, const toml::source_region& region)
{
    return {file, std::max(1U, region.begin.line), std::max(1U, region.begin.column)};
}

/// `fallback` serves tables that no line of the file opens.
Node converted(const toml::node& source, const File& file, const Position& fallback)
{
    Node node;
    node.position = source.source().begin ? position_of(file, source.source()) : fallback;
    node.key_position = node.position;
    if (const auto* table = source.as_table()) {
        for (const auto& [key, value] : *table) {
            const Position key_position = position_of(file, key.source());
            Node member = converted(value, file, key_position);
            member.key_position = key_position;
            node.members.emplace(std::string(key.str()), std::move(member));
        }
    }
    else if (const auto* array = source.as_array()) {
        node.kind = Node::Kind::array;
        for (const toml::node& item : *array)
            node.items.push_back(converted(item, file, node.position));
    }
    else if (const auto* text = source.as_string()) {
        node.kind = Node::Kind::text;
        node.text = text->get();
    }
    else if (const auto* integer = source.as_integer()) {
        node.kind = Node::Kind::integer;
        node.integer = integer->get();
    }
    else if (const auto* number = source.as_floating_point()) {
        node.kind = Node::Kind::number;
        node.number = number->get();
    }
    else if (const auto* boolean = source.as_boolean()) {
        node.kind = Node::Kind::boolean;
        node.boolean = boolean->get();
    }
    else
        refuse(node.position, "value", "dates and times have no meaning in a case file", "write a text or a number");
    return node;
}

Node parse_toml(const std::string& content, const File& file)
{
    try {
        return converted(toml::parse(content, *file), file, {file, 1, 1});
    }
    catch (const toml::parse_error& error) {
        refuse(position_of(file, error.source()), "TOML", std::string(error.description()),
               "correct the file's syntax at this place");
    }
}

/// Takes a text-valued key out of a table.
std::optional<Node> take_text(Node& table, const std::string& key, const std::string& full_key)
{
    const auto found = table.members.find(key);
    if (found == table.members.end()) return std::nullopt;
    Node value = std::move(found->second);
    table.members.erase(found);
    if (!value.is(Node::Kind::text))
        refuse(value.position, full_key, "is " + kind_text(value), "write a text in quotes");
    return value;
}

Node read_with_base(const std::string& path, std::vector<std::string> chain)
{
    Node document = read_toml(path);
    const auto base = take_text(document, "base", "base");
    if (!base) return document;
    const std::string base_path = (fs::path(path).parent_path() / base->text).lexically_normal().string();
    chain.push_back(fs::path(path).lexically_normal().string());
    if (std::find(chain.begin(), chain.end(), base_path) != chain.end())
        refuse(base->position, "base", "the files lie on each other in a circle", "take this line out");
    if (!fs::is_regular_file(base_path))
        refuse(base->position, "base", "there is no file " + base_path,
               "correct the path, which is relative to this file");
    Node merged = read_with_base(base_path, std::move(chain));
    merge(merged, std::move(document));
    return merged;
}

/// Folders named `materials` beside and above a file, nearest first, and the ones that come with the program.
std::vector<fs::path> material_folders(const std::string& file)
{
    std::vector<fs::path> folders;
    std::error_code ignored;
    for (fs::path folder = fs::absolute(file, ignored).parent_path();; folder = folder.parent_path()) {
        if (fs::is_directory(folder / "materials", ignored)) folders.push_back(folder / "materials");
        if (folder == folder.parent_path()) break;
    }
    folders.emplace_back(CUPEL_MATERIALS_FOLDER);
    return folders;
}

void use_material(Node& material, const std::string& key)
{
    const auto use = take_text(material, "use", key + ".use");
    if (!use) return;
    std::vector<std::string> known;
    std::error_code ignored;
    for (const fs::path& folder : material_folders(*use->position.file)) {
        const fs::path candidate = folder / (use->text + ".toml");
        if (fs::is_regular_file(candidate, ignored)) {
            Node merged = read_toml(candidate.lexically_proximate(fs::current_path(ignored)).string());
            merge(merged, std::move(material));
            material = std::move(merged);
            return;
        }
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
    }
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    refuse(use->position, key + ".use", "there is no material file '" + use->text + ".toml'",
           "take one of " + joined(known) + ", or add the file to a folder materials/" + suggestion(use->text, known));
}

/// A value as TOML writes it, or else the plain text that a shell has stripped of its quotes.
Node override_value(const std::string& text, const Position& position)
{
    Node node;
    try {
        const toml::table parsed = toml::parse("value = " + text + "\n", *position.file);
        node = converted(*parsed.get("value"), position.file, position);
    }
    catch (const toml::parse_error&) {
        node.kind = Node::Kind::text;
        node.text = text;
    }
    return node;
}

void place(Node& node, const Position& position)
{
    node.position = position;
    node.key_position = position;
    for (auto& [key, member] : node.members)
        place(member, position);
    for (Node& item : node.items)
        place(item, position);
}

void apply_override(Node& document, const std::string& text, unsigned number)
{
    const Position position{std::make_shared<const std::string>("--set"), number, 1};
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        refuse(position, text, "is no KEY=VALUE", "write for example --set time.end=\"1 ms\"");
    Node value = override_value(text.substr(equals + 1), position);
    place(value, position);

    std::istringstream path(text.substr(0, equals));
    Node* target = &document;
    for (std::string part; std::getline(path, part, '.');) {
        if (target->is(Node::Kind::array)) {
            std::size_t index = 0;
            const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), index);
            if (problem != std::errc{} || end != part.data() + part.size() || index >= target->items.size())
                refuse(position, text.substr(0, equals),
                       "'" + part + "' is no place in a list of " + std::to_string(target->items.size()),
                       "count from 0");
            target = &target->items[index];
            continue;
        }
        if (!target->is(Node::Kind::table)) {
            *target = Node{};
            place(*target, position);
        }
        const auto [found, fresh] = target->members.try_emplace(part);
        target = &found->second;
        if (fresh) place(*target, position);
    }
    *target = std::move(value);
}

/// Digits only, and few enough to be counted.
bool is_index(const std::string& text)
{
    return !text.empty() && text.size() < 9 &&
           std::all_of(text.begin(), text.end(), [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

/// Takes the variations out of a document, in the order in which they stand.
std::vector<std::pair<std::string, Node>> take_variations(Node& document)
{
    std::vector<std::pair<std::string, Node>> variations;
    const auto found = document.members.find("sweep");
    if (found == document.members.end()) return variations;
    Node sweep = std::move(found->second);
    document.members.erase(found);
    if (!sweep.is(Node::Kind::table)) refuse(sweep.position, "sweep", "is " + kind_text(sweep), "write [sweep.NAME]");
    for (auto& [name, variation] : sweep.members) {
        const std::string key = "sweep." + name;
        const auto allowed = [](unsigned char letter) { return std::isalnum(letter) != 0 || letter == '_'; };
        if (name.empty() || !std::all_of(name.begin(), name.end(), allowed))
            refuse(variation.key_position, key, "is no name", "use letters, digits and _ only");
        if (!variation.is(Node::Kind::table))
            refuse(variation.position, key, "is " + kind_text(variation), "write [" + key + "] and keys below it");
        for (const char* whole : {"base", "sweep", "tier"})
            if (const Node* wrong = variation.find(whole))
                refuse(wrong->key_position, key + "." + whole, "cannot vary", "write it at the top of the file");
        variations.emplace_back(name, std::move(variation));
    }
    std::stable_sort(variations.begin(), variations.end(), [](const auto& one, const auto& other) {
        return one.second.key_position.line < other.second.key_position.line;
    });
    return variations;
}

void apply_variation(Node& document, const std::string& path, const std::string& chosen)
{
    auto variations = take_variations(document);
    std::vector<std::string> known;
    for (auto& [name, variation] : variations) {
        if (name == chosen) {
            merge(document, std::move(variation));
            return;
        }
        known.push_back(name);
    }
    const Position place{std::make_shared<const std::string>(path), 1, 1};
    if (known.empty()) {
        if (!chosen.empty()) refuse(place, "--variation", "the case has no variations", "leave it out");
    }
    else if (chosen.empty())
        refuse(place, "--variation", "is missing, the case has variations", "take one of: " + joined(known));
    else
        refuse(place, "--variation", "there is no variation '" + chosen + "'",
               "take one of: " + joined(known) + suggestion(chosen, known));
}

} // namespace

std::string position_text(const Position& position)
{
    return (position.file ? *position.file : "") + ":" + std::to_string(position.line) + ":" +
           std::to_string(position.column);
}

void refuse(const Position& position, const std::string& key, const std::string& what, const std::string& remedy)
{
    std::string line = position_text(position) + ": " + key + ": " + what + "; " + remedy;
    std::replace_if(
        line.begin(), line.end(), [](unsigned char character) { return character < ' '; }, ' ');
    throw CaseError(line);
}

const Node* Node::find(const std::string& key) const
{
    const auto found = members.find(key);
    return found == members.end() ? nullptr : &found->second;
}

std::string kind_text(const Node& node)
{
    switch (node.kind) {
    case Node::Kind::table:
        return "a table";
    case Node::Kind::array:
        return "a list";
    case Node::Kind::text:
        return "the text '" + node.text + "'";
    case Node::Kind::integer:
    case Node::Kind::number:
        return "a number";
    case Node::Kind::boolean:
        return node.boolean ? "true" : "false";
    }
    return "";
}

Node read_toml(const std::string& path)
{
    const auto file = std::make_shared<const std::string>(path);
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream content;
    if (!stream || !(content << stream.rdbuf()))
        refuse({file, 1, 1}, "file", "cannot be read or is empty",
               "check that it exists, is not empty and that you may read it");
    return parse_toml(content.str(), file);
}

void merge(Node& under, Node over)
{
    const bool numbered = over.is(Node::Kind::table) && !over.members.empty() &&
                          std::all_of(over.members.begin(), over.members.end(),
                                      [](const auto& member) { return is_index(member.first); });
    if (under.is(Node::Kind::array) && numbered) {
        for (auto& [number, member] : over.members) {
            const std::size_t index = std::stoul(number);
            if (index >= under.items.size())
                refuse(member.key_position, number, "is no place in a list of " + std::to_string(under.items.size()),
                       "count from 0");
            merge(under.items[index], std::move(member));
        }
        return;
    }
    if (!under.is(Node::Kind::table) || !over.is(Node::Kind::table)) {
        under = std::move(over);
        return;
    }
    under.key_position = over.key_position;
    under.position = over.position;
    for (auto& [key, member] : over.members) {
        const auto [found, fresh] = under.members.try_emplace(key);
        if (fresh)
            found->second = std::move(member);
        else
            merge(found->second, std::move(member));
    }
}

std::vector<std::string> variation_names(const std::string& path)
{
    Node document = read_with_base(path, {});
    std::vector<std::string> names;
    for (const auto& [name, variation] : take_variations(document))
        names.push_back(name);
    return names;
}

Node read_document(const std::string& path, const std::string& variation, const std::vector<std::string>& overrides)
{
    Node document = read_with_base(path, {});
    apply_variation(document, path, variation);
    for (std::size_t number = 0; number < overrides.size(); ++number)
        apply_override(document, overrides[number], static_cast<unsigned>(number) + 1);
    const auto materials = document.members.find("material");
    if (materials != document.members.end() && materials->second.is(Node::Kind::table))
        for (auto& [name, material] : materials->second.members)
            if (material.is(Node::Kind::table)) use_material(material, "material." + name);
    return document;
}

} // namespace cupel
