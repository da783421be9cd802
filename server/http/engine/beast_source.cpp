// Beast is compiled here once and only declared everywhere else (BOOST_BEAST_SEPARATE_COMPILATION).

#include <boost/beast/src.hpp>
