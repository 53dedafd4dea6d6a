// The stand-in for ProposeRegion has to follow the interface file, which another package holds.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

const char kInterface[] = PLANFORMER_NAV2_DIR "/../planformer_msgs/srv/ProposeRegion.srv";

/// The fields as "type name", without comments and constants; "---" parts request and response.
std::vector<std::string> read_fields(std::istream& file) {
    std::vector<std::string> fields;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string type;
        std::string name;
        words >> type >> name;
        if (type == "---") fields.push_back(type);
        if (!name.empty() && name.find('=') == std::string::npos && (words >> std::ws).eof()) {
            fields.push_back(type + " " + name);
        }
    }
    return fields;
}

TEST(ServiceContract, HasTheFieldsOfTheInterfaceFile) {
    std::ifstream file(kInterface);
    if (!file) GTEST_SKIP() << "planformer_msgs does not lie beside this package";
    EXPECT_EQ(read_fields(file),
              (std::vector<std::string>{
                  "std_msgs/Header header", "nav_msgs/MapMetaData info", "uint8[] costs",
                  "geometry_msgs/Pose start", "geometry_msgs/Pose goal", "string guide", "---",
                  "uint16 error_code", "string error_msg", "uint8[] mask", "float64 seconds"}));
}

}  // namespace
