//! Pinion angles, rad, on standard input, one a line; number of the tooth pair and its transmission error, rad, a line each.

use std::io::{self, BufRead};

fn main() {
    let mut mesh = @crate@::Mesh::new();
    for line in io::stdin().lock().lines() {
        let line = line.expect("text on standard input");
        match line.trim().parse::<f64>() {
            Ok(phi) => {
                let contact = mesh.follow(phi);
                println!("{} {:e}", contact.pair, contact.error);
            }
            Err(_) => {
                eprintln!("{:?}: no number; give one angle a line, rad", line);
                std::process::exit(2);
            }
        }
    }
}
