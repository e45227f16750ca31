//! A static file server for this machine alone.
//!
//! By hand: it answers GET and HEAD for a folder of files, which is less code than a server's configuration.

use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::thread;
use std::time::Duration;

/// What the page may do. `index.html` states the same (less `frame-ancestors`, which only a header can), so that a
/// host without headers is as strict. `'wasm-unsafe-eval'` is what compiling WebAssembly is called.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
     img-src 'self'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; \
     base-uri 'none'; form-action 'none'";

/// Only the view that is made for frames may stand in one of another page.
const UNFRAMED: &str = "; frame-ancestors 'none'";

const FIRST_PORT: u16 = 8080;
/// A request line and headers longer than this are nobody's browser.
const LONGEST_REQUEST: u64 = 16 * 1024;

/// Serves `folder` until stopped, on `port` or else the first free one from 8080.
pub fn run(folder: &Path, port: Option<u16>) -> Result<()> {
    let listener = bind(port)?;
    println!("\n  Stepover is at http://{}/  (Ctrl+C stops it)\n", listener.local_addr()?);
    accept(&listener, folder);
    Ok(())
}

/// Serves `folder` in the background for as long as this process lives; returns the address.
pub fn background(folder: PathBuf) -> Result<String> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
    let address = format!("http://{}/", listener.local_addr()?);
    thread::spawn(move || accept(&listener, &folder));
    Ok(address)
}

fn bind(port: Option<u16>) -> Result<TcpListener> {
    if let Some(port) = port {
        return TcpListener::bind((Ipv4Addr::LOCALHOST, port)).with_context(|| format!("port {port}"));
    }
    for port in FIRST_PORT..FIRST_PORT + 100 {
        if let Ok(listener) = TcpListener::bind((Ipv4Addr::LOCALHOST, port)) {
            return Ok(listener);
        }
    }
    bail!("no free port from {FIRST_PORT} on: choose one with --port")
}

fn accept(listener: &TcpListener, folder: &Path) {
    for stream in listener.incoming().flatten() {
        let folder = folder.to_path_buf();
        // A browser that went away in the middle of an answer is no event.
        thread::spawn(move || drop(answer(stream, &folder)));
    }
}

fn answer(mut stream: TcpStream, folder: &Path) -> std::io::Result<()> {
    stream.set_read_timeout(Some(Duration::from_secs(10)))?;
    let mut reader = BufReader::new(stream.try_clone()?.take(LONGEST_REQUEST));
    let mut request = String::new();
    reader.read_line(&mut request)?;
    let mut header = String::new();
    while reader.read_line(&mut header)? > 2 {
        header.clear();
    }

    let mut words = request.split_whitespace();
    let (method, target) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
    if method != "GET" && method != "HEAD" {
        return respond(&mut stream, "405 Method Not Allowed", TEXT, b"GET only\n", true);
    }
    let found = locate(folder, target).and_then(|path| fs::read(&path).ok().map(|bytes| (path, bytes)));
    match found {
        Some((path, bytes)) => {
            let kind = Kind { mime: kind(&path), keeps: keeps(&path), frames: frames(target) };
            respond(&mut stream, "200 OK", kind, &bytes, method == "GET")
        }
        None => respond(&mut stream, "404 Not Found", TEXT, b"not here\n", method == "GET"),
    }
}

/// What a body is.
struct Kind {
    mime: &'static str,
    /// Whether its address names its content, so that it never changes.
    keeps: bool,
    /// Whether another page may show it in a frame.
    frames: bool,
}

const TEXT: Kind = Kind { mime: "text/plain", keeps: false, frames: false };

fn respond(
    stream: &mut TcpStream,
    status: &str,
    kind: Kind,
    body: &[u8],
    with_body: bool,
) -> std::io::Result<()> {
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n\
         Cache-Control: {}\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\nContent-Security-Policy: {POLICY}{}\r\n\r\n",
        kind.mime,
        body.len(),
        // A browser also keeps the machine code of a module whose bytes it may keep.
        if kind.keeps { "public, max-age=31536000, immutable" } else { "no-cache" },
        if kind.frames { "" } else { UNFRAMED },
    )?;
    if with_body {
        stream.write_all(body)?;
    }
    stream.flush()
}

/// The file that a request's target names, if it lies in `folder`.
fn locate(folder: &Path, target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next()?.strip_prefix('/')?;
    // Bundled names are plain: whatever is escaped, or climbs, is not one of ours.
    if path.contains(['%', '\\', ':', '\0']) {
        return None;
    }
    let path = Path::new(path);
    if path.components().any(|part| !matches!(part, Component::Normal(_))) {
        return None;
    }
    let file = folder.join(path);
    let file = if file.is_dir() { file.join("index.html") } else { file };
    // A link inside the folder must not lead out of it.
    let (file, folder) = (file.canonicalize().ok()?, folder.canonicalize().ok()?);
    (file.starts_with(folder) && file.is_file()).then_some(file)
}

/// The bundler writes a hash of the content into the names of what it puts into this folder.
fn keeps(path: &Path) -> bool {
    path.parent().and_then(Path::file_name).is_some_and(|folder| folder == "assets")
}

fn frames(target: &str) -> bool {
    target.split_once('?').is_some_and(|(_, query)| query.split('&').any(|part| part == "embed"))
}

fn kind(path: &Path) -> &'static str {
    match path.extension().and_then(|e| e.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js" | "mjs") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("webmanifest") => "application/manifest+json",
        Some("json") => "application/json",
        Some("png") => "image/png",
        Some("jpg") => "image/jpeg",
        Some("txt") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::root;

    fn get(request: &str) -> String {
        let address = background(root().join("xtask")).unwrap();
        let mut stream = TcpStream::connect(address["http://".len()..].trim_end_matches('/')).unwrap();
        write!(stream, "{request} HTTP/1.1\r\nHost: here\r\n\r\n").unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn files_of_the_folder_are_served_with_the_policy() {
        let text = get("GET /src/serve.rs?x=1");
        assert!(text.starts_with("HTTP/1.1 200 OK\r\n"), "{text}");
        assert!(text.contains("\r\nContent-Security-Policy: default-src 'none'; "));
        assert!(text.ends_with(&fs::read_to_string(root().join("xtask/src/serve.rs")).unwrap()));
        assert!(get("HEAD /Cargo.toml").ends_with("\r\n\r\n"));
        assert!(get("POST /Cargo.toml").starts_with("HTTP/1.1 405 "));
    }

    #[test]
    fn nothing_outside_the_folder_is_served() {
        for target in [
            "/../Cargo.toml",
            "/src/../../Cargo.toml",
            "/%2e%2e/Cargo.toml",
            "//etc/passwd",
            "/none",
            "/",
            "x",
        ] {
            let text = get(&format!("GET {target}"));
            assert!(text.starts_with("HTTP/1.1 404 "), "{target}: {text}");
        }
    }

    #[test]
    fn page_states_the_served_policy() {
        let page = fs::read_to_string(root().join("www/index.html")).unwrap();
        let stated = page.split("http-equiv=\"Content-Security-Policy\"").nth(1).unwrap();
        let stated = stated.split('"').nth(1).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(stated, POLICY);
    }
}
