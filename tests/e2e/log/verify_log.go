// Judges the log of a running fitgauged with golang.org/x/mod/sumdb: signatures of checkpoints, proofs of
// inclusion as the service gives them, and tiles, of which the roots, the records and the consistency of each
// pair of checkpoints are computed. What is forged has to be refused. Reads one JSON object from stdin, writes
// counts to stdout; anything that does not fit ends it with 1.
package main

import (
	"bytes"
	"encoding/binary"
	"encoding/json"
	"fmt"
	"io"
	"net/http"
	"os"
	"strconv"
	"strings"

	"golang.org/x/mod/sumdb/note"
	"golang.org/x/mod/sumdb/tlog"
)

type asked struct {
	Key   string
	Notes []string
	URL   string
	Ids   []string
}

type said struct {
	Records        int64 `json:"records"`
	Inclusions     int   `json:"inclusions"`
	Consistencies  int   `json:"consistencies"`
	ForgedRefused  int   `json:"forged_refused"`
	ForgedAccepted int   `json:"forged_accepted"`
}

type proof struct {
	Index      int64
	Size       int64
	Leaf       string
	Hashes     []string
	Checkpoint string
}

func must(err error) {
	if err != nil {
		fmt.Fprintln(os.Stderr, err)
		os.Exit(1)
	}
}

func get(url string) []byte {
	answer, err := http.Get(url)
	must(err)
	defer answer.Body.Close()
	body, err := io.ReadAll(answer.Body)
	must(err)
	if answer.StatusCode != 200 {
		must(fmt.Errorf("%s: %s %s", url, answer.Status, body))
	}
	return body
}

// A checkpoint has the name of the log, its size and its root.
func tree(text string, verifiers note.Verifiers) (tlog.Tree, error) {
	opened, err := note.Open([]byte(text), verifiers)
	if err != nil {
		return tlog.Tree{}, err
	}
	lines := strings.Split(opened.Text, "\n")
	size, err := strconv.ParseInt(lines[1], 10, 64)
	if err != nil {
		return tlog.Tree{}, err
	}
	root, err := tlog.ParseHash(lines[2])
	return tlog.Tree{N: size, Hash: root}, err
}

// tiles fetches as C2SP tlog-tiles names them; sumdb puts its height into the path.
type tiles struct{ url string }

func (t tiles) Height() int { return 8 }
func (t tiles) ReadTiles(wanted []tlog.Tile) ([][]byte, error) {
	var all [][]byte
	for _, tile := range wanted {
		all = append(all, get(t.url+"/v1/log/"+strings.Replace(tile.Path(), "tile/8/", "tile/", 1)))
	}
	return all, nil
}
func (t tiles) SaveTiles([]tlog.Tile, [][]byte) {}

func flipped(hash tlog.Hash) tlog.Hash {
	hash[7] ^= 1
	return hash
}

// records reads the entry bundles of a tree of size rows.
func records(url string, size int64) [][]byte {
	var all [][]byte
	for begin := int64(0); begin < size; begin += 256 {
		path := tlog.Tile{H: 8, L: 0, N: begin / 256, W: 256}
		if size-begin < 256 {
			path.W = int(size - begin)
		}
		rest := get(url + "/v1/log/" + strings.Replace(path.Path(), "tile/8/0/", "tile/entries/", 1))
		for len(rest) > 0 {
			length := int(binary.BigEndian.Uint16(rest))
			all = append(all, rest[2:2+length])
			rest = rest[2+length:]
		}
	}
	return all
}

func main() {
	var in asked
	var out said
	must(json.NewDecoder(os.Stdin).Decode(&in))
	verifier, err := note.NewVerifier(in.Key)
	must(err)
	verifiers := note.VerifierList(verifier)
	refuse := func(err error) {
		if err == nil {
			out.ForgedAccepted++
		} else {
			out.ForgedRefused++
		}
	}

	var trees []tlog.Tree
	for _, text := range in.Notes {
		head, err := tree(text, verifiers)
		must(err)
		trees = append(trees, head)
		_, err = tree(strings.Replace(text, "\n"+strconv.FormatInt(head.N, 10)+"\n", "\n7777\n", 1), verifiers)
		refuse(err)
	}

	for _, id := range in.Ids {
		var p proof
		must(json.Unmarshal(get(in.URL+"/v1/measurements/"+id+"/proof"), &p))
		head, err := tree(p.Checkpoint, verifiers)
		must(err)
		if head.N != p.Size {
			must(fmt.Errorf("%s: the checkpoint has another size than the proof", id))
		}
		var path tlog.RecordProof
		for _, text := range p.Hashes {
			hash, err := tlog.ParseHash(text)
			must(err)
			path = append(path, hash)
		}
		leaf, err := tlog.ParseHash(p.Leaf)
		must(err)
		must(tlog.CheckRecord(path, head.N, head.Hash, p.Index, leaf))
		refuse(tlog.CheckRecord(path, head.N, head.Hash, p.Index, flipped(leaf)))
		path[0] = flipped(path[0])
		refuse(tlog.CheckRecord(path, head.N, head.Hash, p.Index, leaf))
		out.Inclusions++
	}

	newest := trees[len(trees)-1]
	// TileHashReader holds every tile against the root of the checkpoint.
	reader := tlog.TileHashReader(newest, tiles{in.URL})
	refused := tlog.TileHashReader(tlog.Tree{N: newest.N, Hash: flipped(newest.Hash)}, tiles{in.URL})
	_, err = refused.ReadHashes([]int64{0})
	refuse(err)
	for j := range trees {
		for i := 0; i < j; i++ {
			out.Consistencies++
			if trees[i].N == 0 {
				continue
			}
			path, err := tlog.ProveTree(trees[j].N, trees[i].N, reader)
			must(err)
			must(tlog.CheckTree(path, trees[j].N, trees[j].Hash, trees[i].N, trees[i].Hash))
			refuse(tlog.CheckTree(path, trees[j].N, trees[j].Hash, trees[i].N, flipped(trees[i].Hash)))
		}
	}

	for i, record := range records(in.URL, newest.N) {
		hashes, err := reader.ReadHashes([]int64{tlog.StoredHashIndex(0, int64(i))})
		must(err)
		if hashes[0] != tlog.RecordHash(record) {
			must(fmt.Errorf("entry %d is not what its leaf is of", i))
		}
		var compact bytes.Buffer
		must(json.Compact(&compact, record))
		if !bytes.Equal(compact.Bytes(), record) {
			must(fmt.Errorf("entry %d has blanks", i))
		}
		out.Records++
	}
	must(json.NewEncoder(os.Stdout).Encode(out))
}
