//! Pictures of small scenes with known pixels.

use glam::DVec3;
use radiosity::{Camera, Exposure, Face, Material, Picture, PictureOptions, Rgb, Scene, render};

/// Two horizontal squares, 2 m wide, at heights 0 and 1. The lower one faces up.
fn squares(upper_faces_up: bool) -> Scene {
    let square = |z: f64, up: bool| {
        let mut points: Vec<DVec3> = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| DVec3::new(x, y, z))
            .to_vec();
        if !up {
            points.reverse();
        }
        Face { points, material: 0, object: 0 }
    };
    let faces = [square(0.0, true), square(1.0, upper_faces_up)];
    let (materials, objects) = (vec![Material::default()], vec!["squares".to_owned()]);
    Scene::new(&faces, materials, objects).expect("squares are a scene").0
}

/// Looks straight down from 10 m.
fn from_above() -> Camera {
    Camera {
        eye: DVec3::new(0.0, 0.0, 10.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        field_of_view_degrees: 40.0,
        width: 60,
        height: 40,
    }
}

/// The lower square is red, the upper green where x is negative and blue elsewhere.
fn colour(polygon: u32, point: DVec3) -> Rgb {
    match polygon {
        0 => Rgb::X,
        _ if point.x < 0.0 => Rgb::Y,
        _ => Rgb::Z,
    }
}

fn draw(scene: &Scene, options: PictureOptions) -> Picture {
    let exposure = Exposure::MiddleGrey(1.0);
    render(scene, &from_above(), colour, PictureOptions { exposure, ..options })
        .expect("a small picture")
}

fn pixel(picture: &Picture, column: usize, row: usize) -> [u8; 3] {
    let at = 3 * (row * picture.width as usize + column);
    [picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]]
}

/// Pixels of middle grey and of each colour with that radiosity, calculated by hand from Reinhard's
/// equation 4 (key 0.35, white 2.1) and the sRGB transfer function.
const GREY: [u8; 3] = [144; 3];
const RED: [u8; 3] = [156, 0, 0];
const GREEN: [u8; 3] = [0, 148, 0];
const BLUE: [u8; 3] = [0, 0, 158];
const BACKGROUND: [u8; 3] = [29; 3];

#[test]
fn the_nearer_polygon_is_visible() {
    let picture = draw(&squares(true), PictureOptions::default());
    assert_eq!(pixel(&picture, 28, 20), GREEN);
    assert_eq!(pixel(&picture, 31, 20), BLUE);
    assert_eq!(pixel(&picture, 1, 1), BACKGROUND);
}

#[test]
fn backs_are_invisible() {
    let picture = draw(&squares(false), PictureOptions::default());
    assert_eq!(pixel(&picture, 28, 20), RED);
}

#[test]
fn polygons_above_the_cut_are_omitted() {
    let cut_above = Some((DVec3::Z, 0.0));
    let picture = draw(&squares(true), PictureOptions { cut_above, ..Default::default() });
    assert_eq!(pixel(&picture, 28, 20), RED);
}

#[test]
fn edges_are_projected_in_perspective() {
    // The eye is 9.5 m above the upper square (heights are local), whose edge is 1 m away.
    let picture = draw(&squares(true), PictureOptions::default());
    let edge = 1.0 / (9.5 * 20f64.to_radians().tan()) * 20.0;
    let first = (0..60).find(|&column| pixel(&picture, column, 20) != BACKGROUND);
    assert_eq!(first, Some((30.0 - edge).floor() as usize));
}

#[test]
fn a_camera_inside_a_scene_sees_what_is_ahead() {
    let scene = squares(true);
    let camera = Camera {
        eye: DVec3::NEG_Z * 0.4,
        target: DVec3::new(0.0, 0.9, -0.4),
        up: DVec3::Z,
        ..from_above()
    };
    let picture = render(&scene, &camera, |_, _| Rgb::ONE, PictureOptions::default()).unwrap();
    assert_eq!(pixel(&picture, 30, 39), GREY, "the floor before the eye");
    assert_eq!(pixel(&picture, 30, 0), BACKGROUND);
}

#[test]
fn an_overview_just_contains_the_scene() {
    let scene = squares(true);
    let camera = Camera::overview(&scene.bounds, scene.up, 300, 200);
    let picture = render(&scene, &camera, |_, _| Rgb::ONE, PictureOptions::default()).unwrap();
    let seen: Vec<(usize, usize)> = (0..300 * 200)
        .map(|i| (i % 300, i / 300))
        .filter(|&(column, row)| pixel(&picture, column, row) != BACKGROUND)
        .collect();
    let (left, right) = (seen.iter().map(|s| s.0).min(), seen.iter().map(|s| s.0).max());
    let (top, bottom) = (seen.iter().map(|s| s.1).min(), seen.iter().map(|s| s.1).max());
    let [left, right, top, bottom] = [left, right, top, bottom].map(Option::unwrap);
    assert!(left > 0 && right < 299 && top > 0 && bottom < 199);
    assert!(right - left > 270 || bottom - top > 170, "{left} {right} {top} {bottom}");
}

/// Turned together with its upward direction, a scene looks the same.
#[test]
fn standard_views_follow_what_is_up() {
    let upright = squares(true);
    let turn = |p: DVec3| DVec3::new(p.x, p.z, -p.y);
    let mut lying = upright.clone();
    lying.vertices.iter_mut().for_each(|vertex| *vertex = turn(*vertex));
    for polygon in &mut lying.polygons {
        polygon.plane.normal = turn(polygon.plane.normal);
    }
    let corners = [upright.bounds.min, upright.bounds.max].map(turn);
    lying.bounds.min = corners[0].min(corners[1]);
    lying.bounds.max = corners[0].max(corners[1]);
    for view in [Camera::overview, Camera::inside] {
        for height in [f64::INFINITY, 0.0] {
            let [upright, lying] = [(&upright, DVec3::Z), (&lying, DVec3::Y)].map(|(scene, up)| {
                let cut_above = Some((up, height));
                let options = PictureOptions { cut_above, ..Default::default() };
                render(scene, &view(&scene.bounds, up, 60, 40), colour, options).unwrap()
            });
            let different = upright.rgb.iter().zip(&lying.rgb).filter(|(a, b)| a != b).count();
            assert!(different < upright.rgb.len() / 50, "{different}");
        }
    }
}

#[test]
fn unusual_cameras_do_not_panic() {
    let scene = squares(true);
    let at = |eye, target| Camera { eye, target, ..from_above() };
    let cameras = [
        at(DVec3::ZERO, DVec3::ZERO),
        at(DVec3::ZERO, DVec3::Y),
        at(DVec3::NAN, DVec3::ZERO),
        at(DVec3::INFINITY, DVec3::ZERO),
        Camera { up: DVec3::Z, ..from_above() },
        Camera { field_of_view_degrees: 0.0, ..from_above() },
        Camera { field_of_view_degrees: 180.0, ..from_above() },
    ];
    for camera in cameras {
        let picture = render(&scene, &camera, colour, PictureOptions::default()).unwrap();
        assert_eq!(picture.rgb.len(), 3 * 60 * 40);
    }
    for (width, height) in [(0, 10), (10, 0), (9000, 10)] {
        let camera = Camera { width, height, ..from_above() };
        let refused = render(&scene, &camera, colour, PictureOptions::default());
        let message = refused.expect_err("no such picture").to_string();
        assert!(message.contains("expected 1 to 8192"), "{message}");
    }
}

#[test]
fn a_png_file_contains_the_picture() {
    let picture = draw(&squares(true), PictureOptions::default());
    let bytes = picture.encode_png().unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut decoded).unwrap();
    assert_eq!(decoded, picture.rgb);
    let broken = Picture { width: 7, ..picture };
    assert!(broken.encode_png().is_err());
}
