#include "engine/base/errors.h"
#include "engine/scene/view.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace lightwell {
namespace {

using Kind = View::Kind;
constexpr Kind every_kind[] = {Kind::perspective,   Kind::parallel, Kind::cylindrical,
                               Kind::hemispherical, Kind::angular,  Kind::planisphere};

View view_of(Kind kind, double horizontal, double vertical)
{
    View view;
    view.kind = kind;
    view.horizontal = horizontal;
    view.vertical = vertical;
    return view;
}

/// The view of the table below: nothing in it is simple.
View crooked_view(Kind kind, double horizontal, double vertical)
{
    View view = view_of(kind, horizontal, vertical);
    view.position = {1, 2, 3};
    view.direction = {1, 2, -0.5};
    view.up = {0.1, 0, 1};
    view.shift = 0.1;
    view.lift = -0.05;
    view.fore_m = 0.3;
    view.aft_m = 9;
    return view;
}

double distance(const Vec3& a, const Vec3& b)
{
    return length(a - b);
}

struct KnownRay {
    Kind kind;
    double horizontal, vertical;
    double x, y;  ///< pixel of 128 x 96, y upwards
    Point origin; ///< on the fore clipping surface
    Vec3 to_aft;  ///< from there to the aft one; zero: outside the picture
};

/// vwrays -i -vtX -vp 1 2 3 -vd 1 2 -.5 -vu .1 0 1 -vh H -vv V -vs .1 -vl -.05 -vo .3 -va 9 -x 128 -y 96 -pa 0
/// of Radiance 6.1a, with its output made longer (%.12e).
const KnownRay known_rays[] = {
    {Kind::perspective,
     60,
     40,
     100.5,
     20.25,
     {1.2368161909, 2.188232231, 2.8517885973},
     {6.8676695357, 5.4587346988, -4.2981306797}},
    {Kind::perspective,
     60,
     40,
     3.5,
     70.25,
     {1.0255410139, 2.3272942457, 2.9854863022},
     {0.74068940308, 9.4915331257, -0.42089723725}},
    {Kind::perspective,
     60,
     40,
     64,
     48,
     {1.1609343573, 2.2436893071, 2.9218532345},
     {4.6670963617, 7.0669899059, -2.2662561991}},
    {Kind::parallel,
     6,
     4,
     100.5,
     20.25,
     {2.9519932275, 0.9753852019, 1.430754554},
     {3.7969912901, 7.5939825802, -1.8984956451}},
    {Kind::parallel,
     6,
     4,
     3.5,
     70.25,
     {-0.68723260715, 3.4014521775, 3.8565707874},
     {3.7969912901, 7.5939825802, -1.8984956451}},
    {Kind::parallel,
     6,
     4,
     64,
     48,
     {1.6488743199, 1.9456103723, 2.7054174205},
     {3.7969912901, 7.5939825802, -1.8984956451}},
    {Kind::cylindrical,
     200,
     50,
     100.5,
     20.25,
     {1.2696335068, 1.9051244115, 2.8695342589},
     {7.819371696, -2.7513920667, -3.7835064929}},
    {Kind::cylindrical,
     200,
     50,
     3.5,
     70.25,
     {0.79193713237, 2.214688388, 3.0579265251},
     {-6.0338231613, 6.2259632513, 1.679869228}},
    {Kind::cylindrical,
     200,
     50,
     64,
     48,
     {1.214056426, 2.1936114812, 2.9172262584},
     {6.2076363546, 5.6147329552, -2.4004385075}},
    {Kind::hemispherical, 180, 180, 100.5, 20.25, {0, 0, 0}, {0, 0, 0}},
    {Kind::hemispherical,
     180,
     180,
     3.5,
     70.25,
     {0.89847119072, 2.2669771852, 3.0917337641},
     {-2.9443354691, 7.74233837, 2.6602791602}},
    {Kind::hemispherical,
     180,
     180,
     64,
     48,
     {1.1777336894, 2.2220638486, 2.9046145566},
     {5.1542769929, 6.4398516086, -2.7661778576}},
    {Kind::hemispherical,
     120,
     90,
     100.5,
     20.25,
     {1.227490478, 2.0334039901, 2.8073026833},
     {6.5972238611, 0.96871571324, -5.5882221854}},
    {Kind::hemispherical,
     120,
     90,
     3.5,
     70.25,
     {0.93974420894, 2.2901533119, 3.0466936317},
     {-1.7474179408, 8.4144460448, 1.3541153196}},
    {Kind::hemispherical,
     120,
     90,
     64,
     48,
     {1.1727599943, 2.229126073, 2.9125058456},
     {5.0100398348, 6.6446561162, -2.5373304772}},
    {Kind::angular,
     360,
     180,
     100.5,
     20.25,
     {0.9868185467, 1.7003598994, 2.9935146768},
     {-0.38226214577, -8.6895629166, -0.18807437258}},
    {Kind::angular,
     360,
     180,
     3.5,
     70.25,
     {0.73820518137, 1.9083061234, 3.1142615681},
     {-7.5920497402, -2.6591224213, 3.3135854736}},
    {Kind::angular,
     360,
     180,
     64,
     48,
     {1.2560110591, 2.1154796356, 2.8945353547},
     {7.4243207128, 3.3489094326, -3.0584747124}},
    {Kind::angular,
     200,
     200,
     100.5,
     20.25,
     {1.1336437988, 1.8109068926, 2.8092563715},
     {3.8756701641, -5.4837001136, -5.5315652254}},
    {Kind::angular,
     200,
     200,
     3.5,
     70.25,
     {0.80655500866, 2.1769242126, 3.1458658916},
     {-5.609904749, 5.1308021644, 4.2301108564}},
    {Kind::angular,
     200,
     200,
     64,
     48,
     {1.2062048502, 2.1855831669, 2.8858139767},
     {5.9799406546, 5.3819118406, -3.3113946771}},
    {Kind::planisphere,
     270,
     180,
     100.5,
     20.25,
     {1.107191602, 1.7261081849, 2.9408964121},
     {3.1085564575, -7.942862637, -1.7140040492}},
    {Kind::planisphere,
     270,
     180,
     3.5,
     70.25,
     {0.72049020352, 1.982435552, 3.1075442413},
     {-8.105784098, -0.50936899242, 3.1187829976}},
    {Kind::planisphere,
     270,
     180,
     64,
     48,
     {1.2800921814, 2.0366681014, 2.8989860394},
     {8.1226732614, 1.0633749409, -2.9294048584}},
};

/// Integral of the solid angles of all picture elements.
double total_solid_angle_sr(const Camera& camera, int size)
{
    double sum = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            sum += camera.pixel_solid_angle_sr((x + 0.5) / size, (y + 0.5) / size, size, size);
    return sum;
}

} // namespace

TEST(Camera, GivesTheRaysOfAnotherProgramForEveryKindOfView)
{
    for (const KnownRay& known : known_rays) {
        SCOPED_TRACE(static_cast<char>(known.kind));
        const Camera camera(crooked_view(known.kind, known.horizontal, known.vertical));
        ViewRay ray;
        const bool inside = camera.ray((known.x + 0.5) / 128, (known.y + 0.5) / 96, ray);
        ASSERT_EQ(inside, length(known.to_aft) > 0);
        if (!inside)
            continue;
        EXPECT_LT(distance(ray.origin, known.origin), 1e-9);
        EXPECT_LT(distance(ray.direction * ray.reach_m, known.to_aft), 1e-9);
        EXPECT_NEAR(length(ray.direction), 1, 1e-15);
    }
}

TEST(Camera, SolidAnglesOfPictureElementsAddUpToTheClosedForms)
{
    const auto sine = [](double degrees) { return std::sin(degrees * radians_per_degree); };
    // A pyramid with full angles a and b: 4 asin(sin(a/2) sin(b/2)).
    EXPECT_NEAR(total_solid_angle_sr(Camera(view_of(Kind::perspective, 100, 60)), 400),
                4 * std::asin(sine(50) * sine(30)), 2e-5);
    // A band of the sphere: its angle times the height of the zone.
    EXPECT_NEAR(total_solid_angle_sr(Camera(view_of(Kind::cylindrical, 360, 80)), 400), 2 * pi * 2 * sine(40), 2e-5);
    // The hemisphere; its rim has an infinite density, which a sum over elements meets only slowly.
    EXPECT_NEAR(total_solid_angle_sr(Camera(view_of(Kind::hemispherical, 180, 180)), 3000), 2 * pi, 0.02);
    EXPECT_NEAR(total_solid_angle_sr(Camera(view_of(Kind::angular, 360, 360)), 800), 4 * pi, 1e-4);
    // The square of half side a in the plane of a stereographic projection: 16 s atan(s), s = a / sqrt(1 + a^2).
    const double a = std::tan(65 * radians_per_degree), s = a / std::sqrt(1 + a * a);
    EXPECT_NEAR(total_solid_angle_sr(Camera(view_of(Kind::planisphere, 260, 260)), 800), 16 * s * std::atan(s), 1e-3);
    EXPECT_EQ(total_solid_angle_sr(Camera(view_of(Kind::parallel, 3, 2)), 4), 0);
}

TEST(Camera, TheSolidAngleOfAnElementIsTheOneBetweenTheRaysOfItsCorners)
{
    constexpr int size = 4096;
    for (const Kind kind : every_kind) {
        if (kind == Kind::parallel)
            continue;
        SCOPED_TRACE(static_cast<char>(kind));
        const Camera camera(crooked_view(kind, 120, 70));
        for (const double x : {0.11, 0.37, 0.52})
            for (const double y : {0.21, 0.58, 0.86}) {
                const double step = 0.5 / size;
                ViewRay a, b, c, d;
                ASSERT_TRUE(camera.ray(x - step, y - step, a) && camera.ray(x + step, y + step, c));
                ASSERT_TRUE(camera.ray(x + step, y - step, b) && camera.ray(x - step, y + step, d));
                const double corners = 0.5 * length(cross(c.direction - a.direction, d.direction - b.direction));
                EXPECT_NEAR(camera.pixel_solid_angle_sr(x, y, size, size) / corners, 1, 1e-5);
            }
    }
}

TEST(Camera, ScaleByPowersOfTwoChangesNoBitOfADirection)
{
    for (const Kind kind : every_kind)
        for (const int exponent : {-60, -20, 20, 60}) {
            SCOPED_TRACE(static_cast<char>(kind));
            const double scale = std::ldexp(1.0, exponent);
            View view = crooked_view(kind, 70, 50);
            view.lens_m = 0.2;
            view.focus_m = 4;
            View scaled = view;
            scaled.position = view.position * scale;
            scaled.fore_m *= scale;
            scaled.aft_m *= scale;
            scaled.lens_m *= scale;
            scaled.focus_m *= scale;
            if (kind == Kind::parallel) {
                scaled.horizontal *= scale;
                scaled.vertical *= scale;
            }
            ViewRay ray, far;
            ASSERT_TRUE(Camera(view).ray(0.3, 0.6, {0.2, 0.9}, ray));
            ASSERT_TRUE(Camera(scaled).ray(0.3, 0.6, {0.2, 0.9}, far));
            EXPECT_EQ(ray.direction, far.direction);
            EXPECT_EQ(ray.origin * scale, far.origin);
            EXPECT_EQ(ray.reach_m * scale, far.reach_m);
        }
}

TEST(Camera, RaysOfAllPointsOfTheLensMeetWhereThePictureIsSharp)
{
    for (const Kind kind : every_kind) {
        SCOPED_TRACE(static_cast<char>(kind));
        View view = crooked_view(kind, 100, 60);
        view.fore_m = view.aft_m = 0;
        const Camera pinhole(view);
        view.lens_m = 0.4;
        view.focus_m = 2.5;
        const Camera camera(view);
        ViewRay middle, ray;
        ASSERT_TRUE(pinhole.ray(0.2, 0.7, middle));
        double widest = 0;
        for (const double u : {0.0, 0.13, 0.5, 0.78, 0.999})
            for (const double v : {0.0, 0.31, 0.5, 0.66, 0.999}) {
                ASSERT_TRUE(camera.ray(0.2, 0.7, {u, v}, ray));
                const Vec3 aside = ray.origin - middle.origin;
                widest = std::fmax(widest, length(aside));
                const bool flat = kind == Kind::perspective || kind == Kind::parallel;
                const Direction axis = flat ? normalized(view.direction) : middle.direction;
                EXPECT_NEAR(dot(aside, axis), 0, 1e-12);
                // Sharp at 2.5 m: on a plane across the view direction, along an upright cylinder, on a sphere.
                Direction out = axis;
                if (kind == Kind::cylindrical) {
                    const Direction right = normalized(cross(view.direction, view.up));
                    const Direction up = cross(right, normalized(view.direction));
                    out = normalized(middle.direction - up * dot(middle.direction, up));
                }
                const Point sharp = middle.origin + middle.direction * (2.5 / dot(middle.direction, out));
                EXPECT_LT(length(cross(sharp - ray.origin, ray.direction)), 1e-12);
            }
        EXPECT_NEAR(widest, 0.2, 1e-3);
        ASSERT_TRUE(camera.ray(0.2, 0.7, {0.5, 0.5}, ray));
        EXPECT_LT(distance(ray.direction, middle.direction), 1e-15) << "the middle of the lens is the pinhole";
    }
}

TEST(Camera, TheLengthOfTheDirectionIsTheFocusUnlessOneIsGiven)
{
    View view = view_of(Kind::perspective, 40, 40);
    view.direction = {0, 6, 0};
    view.lens_m = 0.1;
    ViewRay ray;
    ASSERT_TRUE(Camera(view).ray(0.5, 0.5, {0.9, 0.4}, ray));
    EXPECT_NEAR(length(ray.origin + ray.direction * (6 / ray.direction.y)), 6, 1e-12);
    view.focus_m = 2;
    ASSERT_TRUE(Camera(view).ray(0.5, 0.5, {0.9, 0.4}, ray));
    EXPECT_NEAR(length(ray.origin + ray.direction * (2 / ray.direction.y)), 2, 1e-12);
}

TEST(Camera, ClippingIsFlatForPerspectiveAndParallelRoundForTheOthers)
{
    for (const Kind kind : every_kind) {
        SCOPED_TRACE(static_cast<char>(kind));
        View view = view_of(kind, 80, 60);
        view.fore_m = 1;
        view.aft_m = 5;
        const Camera camera(view);
        for (const double x : {0.05, 0.4, 0.9})
            for (const double y : {0.2, 0.95}) {
                ViewRay ray;
                if (!camera.ray(x, y, ray)) // beyond the circle of a fisheye
                    continue;
                const Point near = ray.origin, far = ray.origin + ray.direction * ray.reach_m;
                const auto from_eye = [&](const Point& p) {
                    if (kind == Kind::perspective || kind == Kind::parallel)
                        return p.y;
                    return kind == Kind::cylindrical ? std::hypot(p.x, p.y) : length(p);
                };
                EXPECT_NEAR(from_eye(near), 1, 1e-13);
                EXPECT_NEAR(from_eye(far), 5, 1e-13);
            }
    }
}

TEST(Camera, ExtremeAnglesStillLookWhereTheyShould)
{
    ViewRay ray;
    ASSERT_TRUE(Camera(view_of(Kind::perspective, 1e-6, 1e-6)).ray(1, 0.5, ray));
    EXPECT_NEAR(ray.direction.x, 0.5e-6 * radians_per_degree, 1e-20);
    ASSERT_TRUE(Camera(view_of(Kind::perspective, 179.999, 40)).ray(1, 0.5, ray));
    EXPECT_NEAR(std::acos(ray.direction.x), 0.0005 * radians_per_degree, 1e-9);
    ASSERT_TRUE(Camera(view_of(Kind::cylindrical, 360, 40)).ray(0, 0.5, ray));
    EXPECT_LT(distance(ray.direction, {0, -1, 0}), 1e-15);
    ASSERT_TRUE(Camera(view_of(Kind::angular, 360, 360)).ray(0.75, 0.5, ray));
    EXPECT_LT(distance(ray.direction, {1, 0, 0}), 1e-15);
    ASSERT_TRUE(Camera(view_of(Kind::planisphere, 359.99, 359.99)).ray(1, 0.5, ray));
    EXPECT_NEAR(std::atan2(ray.direction.x, -ray.direction.y), 0.005 * radians_per_degree, 1e-12);
    EXPECT_FALSE(Camera(view_of(Kind::angular, 360, 360)).ray(0.01, 0.01, ray));
    EXPECT_FALSE(Camera(view_of(Kind::hemispherical, 180, 180)).ray(0.01, 0.01, ray));
}

TEST(Camera, ViewsThatCannotBeAreRefusedWithTheNumberThatIsWrong)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [](View view, const char* part) {
        try {
            Camera{view};
            ADD_FAILURE() << "accepted: " << to_text(view);
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    refuses(view_of(Kind::perspective, 180, 40), "-vh is 180");
    refuses(view_of(Kind::perspective, 40, nan), "-vv is nan");
    refuses(view_of(Kind::cylindrical, 361, 40), "-vh is 361");
    refuses(view_of(Kind::cylindrical, 100, 180), "-vv is 180");
    refuses(view_of(Kind::hemispherical, 181, 90), "-vh is 181");
    refuses(view_of(Kind::angular, 361, 90), "-vh is 361");
    refuses(view_of(Kind::planisphere, 360, 90), "-vh is 360");
    refuses(view_of(Kind::parallel, 0, 1), "-vh is 0");
    refuses(view_of(Kind::parallel, infinity, 1), "-vh is inf");
    for (const auto& spoil : {+[](View& v) { v.shift = infinity; }, +[](View& v) { v.lens_m = -1; },
                              +[](View& v) { v.lens_m = std::numeric_limits<double>::quiet_NaN(); },
                              +[](View& v) { v.focus_m = -2; }, +[](View& v) { v.fore_m = -infinity; },
                              +[](View& v) { v.aft_m = -1; }, +[](View& v) { v.fore_m = v.aft_m = 1; },
                              +[](View& v) {
                                  v.direction = {0, 0, 0};
                              },
                              +[](View& v) {
                                  v.up = {0, 2, 0};
                              },
                              +[](View& v) { v.position.x = infinity; }}) {
        View view;
        spoil(view);
        refuses(view, "view");
    }
}

TEST(CroppedView, ShowsWhatThePartOfTheWholeShows)
{
    for (const Kind kind : every_kind) {
        SCOPED_TRACE(static_cast<char>(kind));
        const View whole = crooked_view(kind, 110, 80);
        const View part = cropped(whole, 0.25, 0.5, 0.375, 0.875);
        ViewRay expected, found;
        for (const double x : {0.0, 0.3, 1.0})
            for (const double y : {0.0, 0.6, 1.0}) {
                ASSERT_TRUE(Camera(whole).ray(0.25 + 0.125 * x, 0.5 + 0.375 * y, expected));
                ASSERT_TRUE(Camera(part).ray(x, y, found));
                EXPECT_LT(distance(expected.direction, found.direction), 1e-12);
                EXPECT_LT(distance(expected.origin, found.origin), 1e-10);
            }
    }
}

} // namespace lightwell
