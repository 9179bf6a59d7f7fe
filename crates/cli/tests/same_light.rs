//! Office at the last instant of a run: a browser that draws the report, `virtwall render` and a reader of its
//! glTF file show the same radiosity.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod browser;

use std::fs;
use std::path::Path;
use std::process::Command;

use base64::Engine as _;
use browser::Browser;
use gltf::mesh::util::ReadIndices;
use gltf::{Gltf, Primitive, Semantic};
use lab::{Stage, Which};
use radiosity::glam::{DMat4, DVec3};
use radiosity::{Camera, Exposure, PictureOptions, Plane, Polygon, Rgb, Scene, Tone};

/// Levels of 255 that a pixel may differ by: one since both are rounded to eight bits, and one where two patches
/// that look nearly alike meet inside of it.
const LEVELS: u8 = 2;
/// Neighbours that differ by more make a pixel one of an edge, of an object, a patch or a shadow. There
/// `render` takes the mean of four samples and the browser that of the middle.
const EDGE: u8 = 2;
/// Of all pixels so many, at least, are not on edges, and so compared.
const COMPARED: f64 = 0.6;

fn virtwall(arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(root())
        .args(arguments)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// An image, three bytes a pixel.
struct Image {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
}

impl Image {
    fn of_png(bytes: &[u8]) -> Image {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let samples = info.color_type.samples();
        let rgb = pixels[..info.buffer_size()].chunks(samples).flat_map(|p| &p[..3]).copied();
        Image { width: info.width, height: info.height, rgb: rgb.collect() }
    }

    fn pixel(&self, column: usize, row: usize) -> [u8; 3] {
        let start = 3 * (row * self.width as usize + column);
        [0, 1, 2].map(|colour| self.rgb[start + colour])
    }

    /// Whether a pixel looks like its eight neighbours.
    fn is_plain(&self, column: usize, row: usize) -> bool {
        let mine = self.pixel(column, row);
        let around = |x: usize| x - 1..=x + 1;
        around(column).all(|x| around(row).all(|y| apart(mine, self.pixel(x, y)) <= EDGE))
    }
}

fn apart(a: [u8; 3], b: [u8; 3]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or_default()
}

/// Two images show the same, but at edges.
fn compare(what: &str, one: &Image, other: &Image) {
    assert_eq!((one.width, one.height), (other.width, other.height), "{what}");
    let (width, height) = (one.width as usize, one.height as usize);
    let inner = (1..height - 1).flat_map(|row| (1..width - 1).map(move |column| (column, row)));
    let plain: Vec<(usize, usize)> =
        inner.filter(|&(x, y)| one.is_plain(x, y) && other.is_plain(x, y)).collect();
    let share = plain.len() as f64 / (width * height) as f64;
    let worst = plain.iter().map(|&(x, y)| (apart(one.pixel(x, y), other.pixel(x, y)), x, y)).max();
    println!("{what}: worst {worst:?} of {:.1} % of {width} x {height}", 100.0 * share);
    assert!(share >= COMPARED, "{what}: {share} of all pixels are compared");
    assert!(worst.unwrap().0 <= LEVELS, "{what}: {worst:?}");
}

/// What the page shows, and the radiosity of middle grey.
fn seen_by_browser(page: &mut Browser, smooth: bool, tone: u32) -> (Image, String) {
    page.evaluate(&format!(
        "{{ const [s, t] = ['smooth', 'tone'].map(id => document.getElementById(id)); s.checked = {smooth}; \
         t.value = {tone}; t.dispatchEvent(new Event('input')); }}"
    ));
    page.frame();
    let url = page.text("document.getElementById('picture').toDataURL()");
    let png = base64::engine::general_purpose::STANDARD.decode(url.split_once(',').unwrap().1);
    let scale = page.text("document.getElementById('scale').textContent");
    let middle = scale.split(' ').find(|word| word.parse::<f64>().is_ok()).unwrap().to_owned();
    (Image::of_png(&png.unwrap()), middle)
}

/// The triangles of a glTF file, each with the radiosities at its corners, as a scene that can be drawn.
struct Model {
    scene: Scene,
    light: Vec<[Rgb; 3]>,
}

impl Model {
    /// In the coordinates of `scene`.
    fn read(bytes: &[u8], scene: &Scene) -> Model {
        let file = Gltf::from_slice(bytes).unwrap();
        let blob = file.blob.as_deref().unwrap();
        let node = file.scenes().next().unwrap().nodes().next().unwrap();
        let child = node.children().next().unwrap();
        let matrix = |transform: gltf::scene::Transform| {
            DMat4::from_cols_array_2d(&transform.matrix().map(|column| column.map(f64::from)))
        };
        let placed = matrix(node.transform()) * matrix(child.transform());
        let primitive = child.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(blob));
        // In a glTF file up is y.
        let local = |place: [f32; 3]| {
            let DVec3 { x, y, z } =
                placed.transform_point3(DVec3::from_array(place.map(f64::from)));
            DVec3::new(x, -z, y) - scene.origin
        };
        let vertices: Vec<DVec3> = reader.read_positions().unwrap().map(local).collect();
        let radiosity = radiosities(&primitive, blob);
        let Some(ReadIndices::U32(indices)) = reader.read_indices() else { panic!("32 bits") };
        let indices: Vec<u32> = indices.collect();
        let triangles = || indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
        let polygons = triangles().map(|triangle| polygon(triangle, &vertices)).collect();
        let light = triangles().map(|t| t.map(|vertex| radiosity[vertex as usize])).collect();
        Model { scene: Scene { vertices, polygons, ..scene.clone() }, light }
    }

    fn radiosity_at(&self, triangle: u32, point: DVec3) -> Rgb {
        let polygon = &self.scene.polygons[triangle as usize];
        let corners: Vec<DVec3> = self.scene.corners(polygon).collect();
        let light = self.light[triangle as usize];
        let area =
            |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(polygon.plane.normal);
        let weights = [1, 2, 0].map(|i| area(corners[i], corners[(i + 1) % 3]));
        let sum: Rgb = light.iter().zip(weights).map(|(&rgb, weight)| rgb * weight).sum();
        sum / weights.iter().sum::<f64>()
    }

    fn draw(&self, camera: &Camera, middle: f64, tone: Tone) -> Image {
        let exposure = Exposure::MiddleGrey(middle);
        let options = PictureOptions { exposure, tone, cut_above: None };
        let colour = |triangle, point| self.radiosity_at(triangle, point);
        let picture = radiosity::render(&self.scene, camera, colour, options).unwrap();
        Image { width: picture.width, height: picture.height, rgb: picture.rgb }
    }
}

fn radiosities(primitive: &Primitive, blob: &[u8]) -> Vec<Rgb> {
    let name = Semantic::Extras("RADIOSITY".to_owned());
    let (_, accessor) = primitive.attributes().find(|(semantic, _)| *semantic == name).unwrap();
    let vectors = gltf::accessor::Iter::<[f32; 3]>::new(accessor, |_| Some(blob)).unwrap();
    vectors.map(|rgb| Rgb::from_array(rgb.map(f64::from))).collect()
}

fn polygon(triangle: [u32; 3], vertices: &[DVec3]) -> Polygon {
    let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
    let cross = (b - a).cross(c - a);
    let normal = cross.normalize_or_zero();
    let plane = Plane { normal, offset: normal.dot(a) };
    let area = cross.length() / 2.0;
    Polygon { vertices: triangle.to_vec(), material: 0, object: 0, plane, area }
}

#[test]
fn browser_render_and_gltf_show_the_same_radiosity() {
    let Some(mut page) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    virtwall(&["run", "experiments/quickstart.json", "--set", "processors=8", "--out", out]);
    page.open(&folder.path().join("report.html"));
    page.wait_for("document.getElementById('viewer').dataset.ready !== undefined");
    std::env::set_current_dir(root()).unwrap();
    let stage = Stage::open(out, &Which { set: &[], row: None }).unwrap();
    let scene = &stage.space().scene;
    for (smooth, shading) in [(true, "smooth"), (false, "flat")] {
        for (number, name, tone) in [(0, "reinhard", Tone::Reinhard), (1, "linear", Tone::Linear)] {
            let (browser, middle) = seen_by_browser(&mut page, smooth, number);
            let (png, glb) = (folder.path().join("a.png"), folder.path().join("a.glb"));
            let size = format!("{}x{}", browser.width, browser.height);
            let look =
                ["--size", &size, "--exposure", &middle, "--shading", shading, "--tone", name];
            let files = ["-o", png.to_str().unwrap(), "--gltf", glb.to_str().unwrap()];
            virtwall(&[&["render", out][..], &look, &files].concat());
            let rendered = Image::of_png(&fs::read(&png).unwrap());
            let model = Model::read(&fs::read(&glb).unwrap(), scene);
            let camera = Camera::overview(&scene.bounds, scene.up, browser.width, browser.height);
            let drawn = model.draw(&camera, middle.parse().unwrap(), tone);
            compare(&format!("{shading}, {name}: browser and render"), &browser, &rendered);
            compare(&format!("{shading}, {name}: glTF and render"), &drawn, &rendered);
        }
    }
    assert_eq!(page.complaints(), Vec::<String>::new());
}
