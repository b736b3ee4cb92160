// What the viewer reads and writes for a person: the places of panels, keys, settings.

#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/progress.h"
#include "ui/settings/settings_file.h"
#include "ui/window/viewer.h"
#include "ui/world/input_files.h"

#include <cstddef>
#include <exception>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace octant::ui::window {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t largest_layout_bytes = std::size_t{64} << 10;

fs::path layout_file(const fs::path& folder) { return folder.empty() ? fs::path() : folder / "layout.ini"; }

} // namespace

/// Shows the first steps once for each user. Where the user's folder cannot be written, nothing is kept and the viewer
/// works all the same.
void Viewer::read_layout() {
    if (options_.config_folder.empty()) { return; }
    const fs::path file = layout_file(options_.config_folder);
    try {
        make_folder(options_.config_folder);
        state_.open.first_steps = !path_exists(file);
        if (!state_.open.first_steps) {
            saved_layout_ = layout_from(read_text_file(file, largest_layout_bytes));
            state_.columns.restore_user_placed(*saved_layout_);
        }
    } catch (const Error&) {
        // Panels lie where they lie for a new user; the file is written anew.
    }
}

/// Lines of the file of keys that are wrong are told and left out.
void Viewer::read_keys() {
    if (options_.config_folder.empty()) { return; }
    state_.keys_file = options_.config_folder / "keys";
    state_.keys_file_exists = path_exists(state_.keys_file);
    KeyMapFile read = read_key_map(state_.keys_file);
    state_.keys = std::move(read.keys);
    state_.key_errors = std::move(read.errors);
    input_->set_look_button(state_.keys.look_button);
    for (const std::string& fault : state_.key_errors) { base::print_note(false, fault); }
}

void Viewer::save_layout() noexcept {
    layout_saved_s_ = last_frame_s_;
    if (options_.config_folder.empty()) { return; }
    try {
        saved_layout_ = state_.columns.user_placed();
        write_file(layout_file(options_.config_folder), text_of_layout(*saved_layout_));
    } catch (const std::exception&) { options_.config_folder.clear(); }
}

void Viewer::handle_file_requests(const ViewRequests& requests) {
    try {
        if (requests.write_keys) {
            write_file(state_.keys_file, text_of_key_map(state_.keys));
            state_.keys_file_exists = true;
            show_message(fmt::format("keys: {}", state_.keys_file.string()));
        }
        if (requests.save_settings) {
            settings::RunSettings saved = world::with_absolute_paths(session_->settings());
            saved.drawing.context = settings::ContextKind::OsMesa;
            write_file(*requests.save_settings, settings::settings_json(saved).dump(2) + "\n");
            show_message(fmt::format("settings: {}", requests.save_settings->string()));
        }
        if (requests.load_settings) {
            state_.next_settings = settings::read_settings(*requests.load_settings);
            state_.next_settings.drawing.context = settings::ContextKind::Window;
            fit_to_window();
        }
    } catch (const Error& fault) { show_message(fault.what()); }
}

} // namespace octant::ui::window
