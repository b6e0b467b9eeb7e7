//! The pair in mesh after a million radians, and how far it lets the wheel run ahead, arcseconds.

const ARCSEC: f64 = std::f64::consts::PI / 648000.0;

fn main() {
    let mut mesh = helical::Mesh::new();
    let drive = mesh.cycle(1e6).drive;
    println!("{} {:.9}", drive.pair, drive.error / ARCSEC);
}
