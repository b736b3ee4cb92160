#pragma once

#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "ui/base/json_value.h"
#include "ui/report/frame_record.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// The header line of frames.csv with its line end.
std::string frame_csv_header();

/// One line of frames.csv with its line end: fixed decimals a column, C locale. What is not finite is an empty field;
/// resolution_c, stress, error_px, eye and aircraft places may be that.
std::string frame_csv_line(const FrameRecord& record);

/// The JSON schema of a row of frames.csv: every column by its name.
base::JsonValue frame_schema();

/// The record with its numbers rounded as its line gives them, so that figures computed now and figures computed from
/// the file are the same bit for bit.
FrameRecord rounded_as_csv(const FrameRecord& record);

/// frames.csv row by row, in the memory of one of them: columns may stand in any order, unknown ones are skipped; those
/// that every recording has had from the first (frame_csv.cpp marks them) and those of `required_columns` must be
/// there. An empty file has no rows. Frames must count upwards. Throws Error "file:line: expected ..., got ..." for
/// anything else.
class FrameReader {
public:
    explicit FrameReader(std::filesystem::path path, std::span<const std::string_view> required_columns = {});

    /// The next row, nothing at the end.
    std::optional<FrameRecord> next();

    /// At the end: the last line was cut short (the program was killed) and left out.
    bool is_truncated() const { return is_truncated_; }

private:
    std::filesystem::path path_;
    TextScanner lines_;
    std::vector<std::size_t> columns_; ///< the number of the column that each field belongs to
    std::optional<int> last_frame_;
    bool is_truncated_ = false;
    bool ended_ = false;
};

/// What a frames.csv holds.
struct FrameFile {
    std::vector<FrameRecord> records;
    bool is_truncated = false; ///< the last line was cut short (the program was killed) and left out
};

/// All rows at once, as FrameReader has them; record i stands in line i + 2.
FrameFile read_frame_csv(const std::filesystem::path& path, std::span<const std::string_view> required_columns = {});

} // namespace octant::ui::report
