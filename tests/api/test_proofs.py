from __future__ import annotations

import httpx
import pytest

from deltaq.contract.proof import ProofAnswer, ProofList

pytestmark = pytest.mark.anyio
PROOF = "/api/v1/proofs/dalembert-lagrange"


async def test_proof_in_both_languages(client: httpx.AsyncClient) -> None:
    german, english = [
        ProofAnswer.model_validate((await client.get(PROOF, params={"lang": lang})).json()) for lang in ("de", "en")
    ]
    assert german.title == "Von d'Alembert zu Lagrange: der allgemeine Beweis"
    assert [chapter.id for chapter in german.chapters] == [chapter.id for chapter in english.chapters]
    assert all(step.verified for chapter in english.chapters for step in chapter.steps)


async def test_known_proof_is_not_sent_again(client: httpx.AsyncClient) -> None:
    first = await client.get(PROOF)
    again = await client.get(PROOF, headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


async def test_unknown_proof(client: httpx.AsyncClient) -> None:
    response = await client.get("/api/v1/proofs/fermat", params={"lang": "en"})
    assert response.status_code == 404
    (problem,) = response.json()["problems"]
    assert problem["code"] == "unknown-proof"


async def test_unknown_language(client: httpx.AsyncClient) -> None:
    response = await client.get(PROOF, params={"lang": "fr"})
    assert response.status_code == 422
    assert response.json()["problems"][0]["code"] == "request-not-one-of"


@pytest.mark.parametrize("language", ["de", "en"])
async def test_every_listed_proof_is_there_under_its_title(client: httpx.AsyncClient, language: str) -> None:
    listed = ProofList.model_validate((await client.get("/api/v1/proofs", params={"lang": language})).json()).proofs
    assert "dalembert-lagrange" in [proof.id for proof in listed]
    for entry in listed:
        answer = await client.get(f"/api/v1/proofs/{entry.id}", params={"lang": language})
        assert (answer.status_code, answer.json()["title"]) == (200, entry.title)
