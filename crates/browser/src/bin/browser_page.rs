//! Makes the page that solves a pair by itself: `browser_page FOLDER OUT.html`, with what `wasm-bindgen --target no-modules` has
//! left in the folder.

#[cfg(not(target_family = "wasm"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::{fs, io::Write, path::Path};

    use base64::{Engine, engine::general_purpose::STANDARD};
    use flate2::{Compression, write::GzEncoder};
    use live::page::{Answers, Program, html};
    use scene::Starter;

    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, out] = &words[..] else { return Err("FOLDER OUT.html are wanted".into()) };
    let folder = Path::new(folder);
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&fs::read(folder.join("browser_bg.wasm"))?)?;
    let code = STANDARD.encode(packed.finish()?);
    let calls = fs::read_to_string(folder.join("browser.js"))?;
    let text = Starter { name: "helical-30x30-beta20".into(), ..Starter::default() }.text("scene.toml");
    let answers = Answers::Page(Program { calls: &calls, code: &code });
    Ok(fs::write(out, html((&text, Path::new("scene.toml")), answers)?)?)
}

#[cfg(target_family = "wasm")]
fn main() {}
